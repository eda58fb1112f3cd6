# Install rules: the library with its headers, the files for find_package(bsm) and pkg-config, and the program where it is
# built. The installed tree can be moved: every path in it is relative to the file that holds it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bsm)
install(TARGETS bsm EXPORT bsm-targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES core/include/bsm/bsm.h core/include/bsm/bsm.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bsm)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT bsm-targets NAMESPACE bsm:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/bsm-config.cmake.in ${PROJECT_BINARY_DIR}/bsm-config.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bsm-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bsm-config.cmake ${PROJECT_BINARY_DIR}/bsm-config-version.cmake DESTINATION ${package_dir})

# ${pcfiledir} is the folder that pkg-config found the file in.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
  set(pc_libdir ${CMAKE_INSTALL_LIBDIR})
else()
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" pc_prefix "\${pcfiledir}/${up}")
  set(pc_libdir \${prefix}/${CMAKE_INSTALL_LIBDIR})
endif()
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
else()
  set(pc_includedir \${prefix}/${CMAKE_INSTALL_INCLUDEDIR})
endif()
set(pc_cflags)
if(BUILD_SHARED_LIBS)
  set(pc_cflags " -DBSM_SHARED")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/bsm.pc.in ${PROJECT_BINARY_DIR}/bsm.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/bsm.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET bsm_program)
  install(TARGETS bsm_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET bsm_program AND BUILD_SHARED_LIBS)
  # The installed program finds the library beside it.
  file(RELATIVE_PATH to_library ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  if(APPLE)
    set_target_properties(bsm_program PROPERTIES INSTALL_RPATH @loader_path/${to_library})
  else()
    set_target_properties(bsm_program PROPERTIES INSTALL_RPATH $ORIGIN/${to_library})
  endif()
endif()
