# Builds the page's script and style with npm, TypeScript and Vite in the build folder, so that the source stays clean.
# The page of a machine is built beside it, with an entry of its own. Sets PROBEWRIGHT_WEB_DIST, the folder of the results, and PROBEWRIGHT_WEB_FILES, the results.

find_program(NPM_EXECUTABLE npm)
find_program(NODE_EXECUTABLE node)
if(NOT NPM_EXECUTABLE OR NOT NODE_EXECUTABLE)
  message(
    FATAL_ERROR "npm and node are needed to build the report's page but were not found. "
                "On Debian: apt-get install nodejs npm. Elsewhere: install Node.js 18 or later, then configure again.")
endif()
execute_process(COMMAND ${NODE_EXECUTABLE} --version OUTPUT_VARIABLE node_version OUTPUT_STRIP_TRAILING_WHITESPACE)
if(node_version MATCHES "^v([0-9]+)" AND CMAKE_MATCH_1 LESS 18)
  message(FATAL_ERROR "Node.js ${node_version} is too old to build the report's page; version 18 or later is needed.")
endif()

set(web_source ${CMAKE_CURRENT_LIST_DIR})
set(web_build ${CMAKE_BINARY_DIR}/web)
set(PROBEWRIGHT_WEB_DIST ${web_build}/dist)
set(PROBEWRIGHT_WEB_FILES ${PROBEWRIGHT_WEB_DIST}/report.js ${PROBEWRIGHT_WEB_DIST}/report.css
                         ${PROBEWRIGHT_WEB_DIST}/machine.js ${PROBEWRIGHT_WEB_DIST}/machine.css)

set(web_manifest ${web_source}/package.json ${web_source}/package-lock.json ${web_source}/.npmrc)
add_custom_command(
  OUTPUT ${web_build}/packages.stamp
  COMMAND ${CMAKE_COMMAND} -E make_directory ${web_build}
  COMMAND ${CMAKE_COMMAND} -E copy ${web_manifest} ${web_build}
  COMMAND ${NPM_EXECUTABLE} --prefix ${web_build} ci --prefer-offline --loglevel=error
  COMMAND ${CMAKE_COMMAND} -E touch ${web_build}/packages.stamp
  DEPENDS ${web_manifest}
  WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
  COMMENT "Fetching the page's packages"
  VERBATIM)

file(GLOB web_sources CONFIGURE_DEPENDS ${web_source}/src/*.ts ${web_source}/src/*.css ${web_source}/src/texts/* ${web_source}/test/*.mjs)
set(web_configuration ${web_source}/tsconfig.json ${web_source}/vite.config.ts ${web_source}/vite.machine.config.ts)
add_custom_command(
  OUTPUT ${PROBEWRIGHT_WEB_FILES}
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${web_build}/src ${web_build}/test
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web_source}/src ${web_build}/src
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web_source}/test ${web_build}/test
  COMMAND ${CMAKE_COMMAND} -E copy ${web_configuration} ${web_build}
  COMMAND ${NPM_EXECUTABLE} --prefix ${web_build} --loglevel=error run --silent build
  COMMAND ${NODE_EXECUTABLE} ${web_build}/node_modules/vite/bin/vite.js build ${web_build} --config ${web_build}/vite.machine.config.ts
  DEPENDS ${web_build}/packages.stamp ${web_sources} ${web_configuration}
  WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
  COMMENT "Building the page"
  VERBATIM)
