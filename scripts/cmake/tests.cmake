# One test program per folder from the *_test.cpp files beside its sources (fixtures in testing/), and one test entry per
# suite, so that a suite's fixture is built once. Labels: unit; stage (the pipeline's variants); road (the whole way from
# scene to report); golden.
find_package(GTest REQUIRED)

# Suites by name, as the sources declare them.
function(dressform_suites result)
  set(suites "")
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${file} lines REGEX "^(TEST|TEST_F|TEST_P|TYPED_TEST)\\(")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[A-Z_]+\\(([A-Za-z0-9_]+).*" "\\1" suite "${line}")
      list(APPEND suites ${suite})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(${result} ${suites} PARENT_SCOPE)
endfunction()

function(dressform_tests folder label)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*_test.cpp)
  file(GLOB_RECURSE fixtures CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/testing/*.cpp)
  add_executable(${folder}_test ${tests} ${fixtures})
  dressform_unity(${folder}_test ${tests} ${fixtures})
  dressform_precompiled(${folder}_test test_headers.h)
  dressform_link(${folder}_test ${ARGN} ${folder})
  target_link_libraries(${folder}_test PRIVATE GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${folder}_test PRIVATE DRESSFORM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_compile_options(${folder}_test PRIVATE -O1)  # a sixth quicker to compile; what they test is optimised
  dressform_suites(suites ${tests} ${fixtures})
  set(filters "")
  foreach(suite IN LISTS suites)
    set(filter "${suite}.*:*/${suite}.*:${suite}/*:*/${suite}/*")
    string(APPEND filters ":${filter}")
    add_test(NAME ${folder}.${suite} COMMAND ${folder}_test --gtest_brief=1 --gtest_filter=${filter})
    # A folder of its own for its files (testing::TempDir): suites run at the same time.
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/tmp/${folder}.${suite})
    set_tests_properties(${folder}.${suite} PROPERTIES TIMEOUT 900 LABELS ${label}
                         ENVIRONMENT TEST_TMPDIR=${CMAKE_BINARY_DIR}/tmp/${folder}.${suite})
    if(suite MATCHES "^EndToEnd")  # the longest go first; two at a time keep two cores busier than one on both
      set_tests_properties(${folder}.${suite} PROPERTIES LABELS road COST 1000)
    endif()
  endforeach()
  # A suite that no entry above names would never run: nothing may be left when all of them are taken away.
  add_test(NAME ${folder}.every_suite_has_an_entry COMMAND ${folder}_test --gtest_list_tests --gtest_filter=-${filters})
  set_tests_properties(${folder}.every_suite_has_an_entry PROPERTIES FAIL_REGULAR_EXPRESSION "[A-Za-z0-9_]\\.[ \n]" LABELS unit)
endfunction()

dressform_tests(scenes unit)
dressform_tests(synthetic unit scenes)
dressform_tests(pipeline stage scenes)
dressform_tests(render unit scenes)
dressform_tests(eval unit scenes synthetic pipeline render)
target_compile_definitions(eval_test PRIVATE DRESSFORM_PROGRAM="$<TARGET_FILE:dressform>")
add_dependencies(eval_test dressform)

# A golden case a test, one thread each: two at a time keep two cores busier than one on both. The first one goes before
# the others, which take the scans' bodies from its store.
file(GLOB goldens CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/golden/*/golden.json)
set(first "")
foreach(golden IN LISTS goldens)
  get_filename_component(case ${golden} DIRECTORY)
  get_filename_component(case ${case} NAME)
  add_test(NAME golden.${case} COMMAND dressform gate check ${case} --threads 1 --golden ${CMAKE_SOURCE_DIR}/golden
                                       --work ${CMAKE_BINARY_DIR}/gate
                                       --junit ${CMAKE_BINARY_DIR}/gate/${case}.xml)
  set_tests_properties(golden.${case} PROPERTIES TIMEOUT 1500 LABELS golden COST 2000)
  if(first)
    set_tests_properties(golden.${case} PROPERTIES DEPENDS ${first})
  else()
    set(first golden.${case})
  endif()
endforeach()

add_test(NAME layers COMMAND ${CMAKE_SOURCE_DIR}/scripts/check_layers ${CMAKE_SOURCE_DIR})
set_tests_properties(layers PROPERTIES LABELS unit)
set(objects "")
if(NOT DRESSFORM_UNITY)
  set(objects --objects ${CMAKE_BINARY_DIR})
endif()
add_test(NAME house COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/scripts/house_test ${objects})
set_tests_properties(house PROPERTIES LABELS unit)
# Installs the build, runs the installed program, and builds the example that uses find_package(dressform).
add_test(NAME package COMMAND ${CMAKE_SOURCE_DIR}/scripts/package_test ${CMAKE_BINARY_DIR})
set_tests_properties(package PROPERTIES LABELS unit TIMEOUT 600)
add_dependencies(eval_test dressform_archive)
# The example of a foreign pipeline, built as a stranger builds it, and a study that runs it.
add_subdirectory(scripts/examples/open3d_pipeline ${CMAKE_BINARY_DIR}/open3d_pipeline)
add_test(NAME foreign_pipeline COMMAND ${CMAKE_SOURCE_DIR}/scripts/foreign_pipeline_test $<TARGET_FILE:dressform>
                                       $<TARGET_FILE:open3d_pipeline>)
set_tests_properties(foreign_pipeline PROPERTIES LABELS unit TIMEOUT 600)
