# Manual pages and completions, made by the program itself from its options.
set(pages ${PROJECT_BINARY_DIR}/pages)
set(completions ${pages}/bash/barycert ${pages}/bash/barycert-tetgen ${pages}/zsh/_barycert ${pages}/zsh/_barycert-tetgen
  ${pages}/fish/barycert.fish ${pages}/fish/barycert-tetgen.fish)
set(commands "")
foreach(file IN LISTS completions)
  get_filename_component(folder ${file} DIRECTORY)
  get_filename_component(shell ${folder} NAME)
  set(of "")
  if(file MATCHES tetgen)
    set(of mesh)
  endif()
  list(APPEND commands COMMAND barycert_cli help ${of} --completion ${shell} > ${file})
endforeach()
add_custom_command(OUTPUT ${pages}/man1/barycert.1 ${completions} DEPENDS barycert_cli
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}/bash ${pages}/zsh ${pages}/fish
  COMMAND barycert_cli help --man ${pages}/man1 ${commands} VERBATIM)
add_custom_target(barycert_pages ALL DEPENDS ${pages}/man1/barycert.1)

# Pages of barycert-tetgen, which `barycert mesh` runs, where it is installed.
set(of_tetgen "/barycert-(tetgen|mesh)\\.1$")
install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT cli REGEX ${of_tetgen} EXCLUDE)
install(FILES ${pages}/bash/barycert DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT cli)
install(FILES ${pages}/zsh/_barycert DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT cli)
install(FILES ${pages}/fish/barycert.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT cli)
if(TARGET barycert-tetgen)
  install(FILES ${pages}/man1/barycert-tetgen.1 ${pages}/man1/barycert-mesh.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tetgen)
  install(FILES ${pages}/bash/barycert-tetgen DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tetgen)
  install(FILES ${pages}/zsh/_barycert-tetgen DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tetgen)
  install(FILES ${pages}/fish/barycert-tetgen.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tetgen)
endif()
