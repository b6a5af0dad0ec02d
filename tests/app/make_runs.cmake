# Leaves the reports of a few runs in folders of OUT, for the tests in a browser. Usage: cmake -DPROGRAM=.. -DOUT=.. -P
# make_runs.cmake, in the root of the sources.
function(run name code)
  execute_process(COMMAND ${PROGRAM} run ${ARGN} --out ${OUT}/${name} --quiet RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(NOT result EQUAL code)
    message(FATAL_ERROR "${name} ended with ${result}, not with ${code}: ${errors}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${OUT})
run(housing 0 examples/programs/housing.h --setup examples/setups/housing-tnc640.toml --clearance)
run(lathe 1 examples/programs/shaft.mpf --setup examples/setups/shaft-lathe.toml)
# The control believes the part 15 mm higher than it lies: the probe touches where nothing is.
file(READ examples/setups/housing-tnc640.toml setup)
string(REPLACE "origin = [-60, -40, -470]" "origin = [-60, -40, -455]" higher "${setup}")
if(higher STREQUAL setup)
  message(FATAL_ERROR "the setup of the housing has no preset to change")
endif()
string(REPLACE "../" "${CMAKE_CURRENT_SOURCE_DIR}/examples/" higher "${higher}")
file(WRITE ${OUT}/higher.toml "${higher}")
run(alarm 3 examples/programs/housing.h --setup ${OUT}/higher.toml)
