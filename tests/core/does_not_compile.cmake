# Compiles SOURCE with each of FLAGS and expects it to fail with MESSAGE; without the flags it has to pass, or the test
# would prove nothing. -DCOMPILER= -DSOURCE= -DINCLUDE= -DINCLUDE_TOO= "-DFLAGS=..;.." -DMESSAGE=
set(command ${COMPILER} -std=c++20 -fsyntax-only -ffp-contract=off -DBARYCERT_VERSION="x" -I${INCLUDE} -I${INCLUDE_TOO} ${SOURCE})
execute_process(COMMAND ${command} RESULT_VARIABLE plain ERROR_VARIABLE errors)
if(NOT plain EQUAL 0)
  message(FATAL_ERROR "${SOURCE} does not compile at all:\n${errors}")
endif()
foreach(flag IN LISTS FLAGS)
  # The first error is enough.
  execute_process(COMMAND ${command} ${flag} -Wfatal-errors RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(result EQUAL 0)
    message(FATAL_ERROR "${SOURCE} compiles with ${flag}")
  endif()
  if(NOT errors MATCHES "${MESSAGE}")
    message(FATAL_ERROR "${SOURCE} with ${flag}: no word of \"${MESSAGE}\" in\n${errors}")
  endif()
endforeach()
