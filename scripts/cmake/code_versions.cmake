# The code version of every stage, derived at build time from its own sources and from what all stages share, so that
# nobody has to remember to bump it. Written to generated/code_versions.inc as {"stage", "hash"}, lines.
file(GLOB_RECURSE versioned CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/scenes/*.h ${CMAKE_SOURCE_DIR}/scenes/*.cpp
     ${CMAKE_SOURCE_DIR}/pipeline/*.h ${CMAKE_SOURCE_DIR}/pipeline/*.cpp
     ${CMAKE_SOURCE_DIR}/synthetic/*.h ${CMAKE_SOURCE_DIR}/synthetic/*.cpp
     ${CMAKE_SOURCE_DIR}/render/*.h ${CMAKE_SOURCE_DIR}/render/*.cpp
     ${CMAKE_SOURCE_DIR}/eval/*.h ${CMAKE_SOURCE_DIR}/eval/*.cpp)
list(FILTER versioned EXCLUDE REGEX "_(test|bench)\\.cpp$")
set(code_versions ${CMAKE_BINARY_DIR}/generated/code_versions.inc)
add_custom_command(
  OUTPUT ${code_versions}
  COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR} -DOUTPUT=${code_versions}
          -P ${CMAKE_SOURCE_DIR}/scripts/cmake/write_code_versions.cmake
  DEPENDS ${versioned} ${CMAKE_SOURCE_DIR}/scripts/cmake/write_code_versions.cmake
  COMMENT "Deriving the code versions of the stages")
add_custom_target(code_versions DEPENDS ${code_versions})
add_dependencies(pipeline code_versions)
add_dependencies(eval code_versions)
