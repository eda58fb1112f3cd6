# The target bsm_amalgamation: the library as two files, amalgamation/bsm/bsm.h and bsm.cpp in the build folder.
set(out ${PROJECT_BINARY_DIR}/amalgamation/bsm)
get_target_property(sources bsm SOURCES)
get_target_property(guarded bsm BSM_GUARDED_SOURCES)
list(TRANSFORM sources PREPEND core/ REGEX "^[a-z]")
list(TRANSFORM sources REPLACE "^${PROJECT_SOURCE_DIR}/" "")
file(GLOB_RECURSE inputs CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/core/*.h ${PROJECT_SOURCE_DIR}/core/*.cpp
  ${PROJECT_SOURCE_DIR}/simd/*.h ${PROJECT_SOURCE_DIR}/simd/*.cpp ${PROJECT_SOURCE_DIR}/simd/*.def)
file(GLOB facts CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/platform/*.h ${PROJECT_SOURCE_DIR}/platform/*.cpp ${PROJECT_SOURCE_DIR}/platform/*.def)
add_custom_command(OUTPUT ${out}/bsm.h ${out}/bsm.cpp
  COMMAND ${CMAKE_COMMAND} "-DSOURCES=${sources}" "-DGUARDED=${guarded}" -DVERSION=${PROJECT_VERSION} -DOUT=${out}
          -P ${CMAKE_CURRENT_LIST_DIR}/amalgamate.cmake
  DEPENDS ${inputs} ${facts} ${PROJECT_SOURCE_DIR}/LICENSE
          ${CMAKE_CURRENT_LIST_DIR}/amalgamate.cmake ${CMAKE_CURRENT_LIST_DIR}/bsm.cpp.in
  COMMENT "Writing ${out}/bsm.h and bsm.cpp" VERBATIM)
add_custom_target(bsm_amalgamation DEPENDS ${out}/bsm.h ${out}/bsm.cpp)
