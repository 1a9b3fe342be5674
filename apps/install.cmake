# What is installed, and the Debian package made of it (cpack in the build folder). The version is
# that of project() in the first CMakeLists.txt.
include(GNUInstallDirs)
set(DOCUMENTS ${CMAKE_INSTALL_DATADIR}/doc/walktrack)

install(TARGETS walktrack DESTINATION ${CMAKE_INSTALL_BINDIR})

# The manual comes from the program itself, and is there whenever the program is.
set(MANUAL ${CMAKE_CURRENT_BINARY_DIR}/walktrack.1.gz)
add_custom_command(TARGET walktrack POST_BUILD VERBATIM BYPRODUCTS ${MANUAL}
  COMMAND sh -c "\"$<TARGET_FILE:walktrack>\" --help-man | gzip -9n > \"${MANUAL}\"")
install(FILES ${MANUAL} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

install(FILES completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME walktrack)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs ${PROJECT_SOURCE_DIR}/data/demo ${PROJECT_SOURCE_DIR}/data/opensim ${PROJECT_SOURCE_DIR}/data/schemas
  DESTINATION ${CMAKE_INSTALL_DATADIR}/walktrack)
if(WALKTRACK_HAS_POSE_NET)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/pose_net DESTINATION ${CMAKE_INSTALL_DATADIR}/walktrack)
endif()
# Where Debian's Python looks, with the prefix /usr.
install(FILES python/walktrack.py DESTINATION lib/python3/dist-packages)
install(DIRECTORY guide DESTINATION ${DOCUMENTS})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${DOCUMENTS} RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME walktrack)
set(CPACK_PACKAGE_CONTACT "the walktrack authors <walktrack@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "tracks a walking person in calibrated video")
set(CPACK_PACKAGE_DESCRIPTION "A particle filter whose motion model is a simulated kneed walker follows one person
through the videos of one or more calibrated cameras. It writes joints, angles, gait and
forces with their uncertainty, files for OpenSim, overlay videos and a report.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-numpy, python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # dependencies: the packages of the libraries that it loads
include(CPack)
