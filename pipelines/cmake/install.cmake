# What `cmake --install` puts down: the commands (overlook_command does that), the libraries with their headers, and what
# find_package(overlook) reads. Headers are included as in the repository: #include "formats/terrain.h".
include(CMakePackageConfigHelpers)

set(OVERLOOK_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/overlook)
set(OVERLOOK_HAS_DRAWING OFF)
foreach(library formats view stream terrain_refine caveclod_refine command gl terrain_draw caveclod_draw)
  if(NOT TARGET ${library})
    continue()
  endif()
  install(TARGETS ${library} EXPORT overlookTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  # The headers of the library's room; where deciding and drawing share one, both name the same files.
  get_target_property(room ${library} SOURCE_DIR)
  file(RELATIVE_PATH room_from_root ${PROJECT_SOURCE_DIR} ${room})
  install(DIRECTORY ${room}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/overlook/${room_from_root}
          FILES_MATCHING PATTERN "*.h" PATTERN "spec" EXCLUDE)
  if(library STREQUAL "gl")
    set(OVERLOOK_HAS_DRAWING ON)
  endif()
endforeach()

install(EXPORT overlookTargets NAMESPACE overlook:: DESTINATION ${OVERLOOK_PACKAGE_DIR})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/overlookConfig.cmake.in
  ${PROJECT_BINARY_DIR}/overlookConfig.cmake INSTALL_DESTINATION ${OVERLOOK_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/overlookConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/overlookConfig.cmake ${PROJECT_BINARY_DIR}/overlookConfigVersion.cmake
  DESTINATION ${OVERLOOK_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
