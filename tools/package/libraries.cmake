# Installs the libraries and their headers for find_package(crackle). Paths in #include are relative to include/crackle.
include(CMakePackageConfigHelpers)
set(CRACKLE_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/crackle)
set_target_properties(crackle_solver PROPERTIES EXPORT_NAME solver)
set_target_properties(crackle_mesher PROPERTIES EXPORT_NAME mesher)
set_target_properties(crackle_specimens PROPERTIES EXPORT_NAME specimens)
install(TARGETS crackle_solver crackle_mesher crackle_specimens EXPORT crackleTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crackle COMPONENT development)
# Included by public headers, but not meant to be included directly.
install(FILES ${PROJECT_SOURCE_DIR}/solver/base/lanes.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/crackle/solver/base
    COMPONENT development)
install(EXPORT crackleTargets NAMESPACE crackle:: DESTINATION ${CRACKLE_CONFIG_DIR} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/crackleConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/crackleConfig.cmake
    INSTALL_DESTINATION ${CRACKLE_CONFIG_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/crackleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crackleConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/crackleConfigVersion.cmake
    DESTINATION ${CRACKLE_CONFIG_DIR} COMPONENT development)
