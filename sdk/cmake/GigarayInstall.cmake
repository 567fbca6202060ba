# SPDX-License-Identifier: BSD-3-Clause
# find_package(gigaray CONFIG) after `cmake --install`.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY GIGARAY_LIBRARIES)
get_property(shared_libraries GLOBAL PROPERTY GIGARAY_SHARED_LIBRARIES)
install(TARGETS ${libraries} EXPORT gigarayTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS ${shared_libraries} EXPORT gigarayTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
list(TRANSFORM libraries REPLACE "^gigaray_" "" OUTPUT_VARIABLE GIGARAY_LAYERS)
install(EXPORT gigarayTargets NAMESPACE gigaray::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gigaray)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gigarayConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/gigarayConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gigaray)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/gigarayConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gigarayConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/gigarayConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gigaray)
