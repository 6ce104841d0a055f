# The code version of every stage, derived at build time from all that its files include and link (scripts/code_versions).
# Written to generated/code_versions.inc as {"stage", "hash"}, lines.
file(GLOB_RECURSE versioned CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scenes/*.h ${CMAKE_SOURCE_DIR}/scenes/*.cpp
     ${CMAKE_SOURCE_DIR}/pipeline/*.h ${CMAKE_SOURCE_DIR}/pipeline/*.cpp
     ${CMAKE_SOURCE_DIR}/synthetic/*.h ${CMAKE_SOURCE_DIR}/synthetic/*.cpp
     ${CMAKE_SOURCE_DIR}/render/*.h ${CMAKE_SOURCE_DIR}/render/*.cpp
     ${CMAKE_SOURCE_DIR}/eval/*.h ${CMAKE_SOURCE_DIR}/eval/*.cpp)
list(FILTER versioned EXCLUDE REGEX "(_test|_bench|_fuzz)\\.cpp$|/testing/")
set(code_versions ${CMAKE_BINARY_DIR}/generated/code_versions.inc)
add_custom_command(
  OUTPUT ${code_versions}
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/scripts/code_versions -o ${code_versions}
  DEPENDS ${versioned} ${CMAKE_SOURCE_DIR}/scripts/code_versions
  COMMENT "Deriving the code versions of the stages")
add_custom_target(code_versions DEPENDS ${code_versions})
add_dependencies(pipeline code_versions)
add_dependencies(eval code_versions)
