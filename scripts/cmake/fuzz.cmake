# One fuzz program for each *_fuzz.cpp beside the reader that it feeds. With the preset `fuzz` (clang) it is libFuzzer's:
#   .build/fuzz/obj_fuzz -max_total_time=30 found/ scenes/formats/corpus/obj
# Otherwise it only replays files and folders of files. Its corpus, corpus/<name> beside it, is replayed by the tests.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS "-fsanitize=fuzzer")
check_cxx_source_compiles(
  "#include <cstddef>
   #include <cstdint>
   extern \"C\" int LLVMFuzzerTestOneInput(const uint8_t*, size_t) { return 0; }"
  DRESSFORM_LIBFUZZER)
unset(CMAKE_REQUIRED_FLAGS)

add_custom_target(fuzzers)
foreach(folder scenes synthetic pipeline render eval)
  list(APPEND below ${folder})  # a fuzz program links its folder and those below, as the tests do
  file(GLOB_RECURSE fuzz_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*_fuzz.cpp)
  foreach(file ${fuzz_files})
    get_filename_component(program ${file} NAME_WE)
    get_filename_component(directory ${file} DIRECTORY)
    string(REGEX REPLACE "_fuzz$" "" name ${program})
    add_executable(${program} ${file})
    target_compile_options(${program} PRIVATE -O1)
    if(folder STREQUAL "scenes")
      dressform_link(${program} scenes)
    else()
      dressform_link(${program} ${below})
    endif()
    if(DRESSFORM_LIBFUZZER AND CMAKE_CXX_FLAGS_DEBUG MATCHES "fuzzer")
      target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    else()
      target_sources(${program} PRIVATE ${CMAKE_SOURCE_DIR}/scripts/cmake/replay_corpus.cpp)
    endif()
    add_dependencies(fuzzers ${program})
    file(GLOB corpus CONFIGURE_DEPENDS ${directory}/corpus/${name}/*)
    add_test(NAME fuzz.${name} COMMAND ${program} ${corpus})
  endforeach()
endforeach()
