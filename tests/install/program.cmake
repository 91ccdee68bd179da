# Runs the installed program from a place of its own (cmake -DPREFIX=... -DMOVED=... -DSOURCE_DATA=... -P program.cmake).
file(REMOVE_RECURSE ${MOVED})
file(COPY ${PREFIX}/ DESTINATION ${MOVED})
execute_process(COMMAND ${MOVED}/bin/barycert audit --count 1 --family mesh.inside --json ${MOVED}/audit.json
  RESULT_VARIABLE code OUTPUT_VARIABLE table ERROR_VARIABLE errors)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "exit code ${code}: ${errors}")
endif()
# Adds a mesh: the program finds it only if it uses the installed copy of the data.
file(GLOB meshes ${SOURCE_DATA}/meshes/*.node)
list(LENGTH meshes expected)
foreach(ending node ele)
  file(COPY_FILE ${MOVED}/share/barycert/data/meshes/plate.${ending} ${MOVED}/share/barycert/data/meshes/one-more.${ending})
endforeach()
execute_process(COMMAND ${MOVED}/bin/barycert audit --count 1 --family mesh.inside --json ${MOVED}/more.json
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
foreach(file audit more)
  file(READ ${MOVED}/${file}.json json)
  string(JSON ${file} LENGTH "${json}" meshes)
endforeach()
math(EXPR one_more "${expected} + 1")
if(NOT audit EQUAL expected OR NOT more EQUAL one_more)
  message(FATAL_ERROR "meshes: ${audit} and ${more}, expected ${expected} and ${one_more}")
endif()
