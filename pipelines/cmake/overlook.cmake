# What every Overlook target shares: warnings, sanitizers, and arithmetic that gives the same bytes everywhere.

add_library(overlook_options INTERFACE)
target_compile_options(overlook_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# g++ 12 sees overlaps in std::string's own code that are not there (GCC bug 105651).
target_compile_options(overlook_options INTERFACE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
if(OVERLOOK_WERROR)
  target_compile_options(overlook_options INTERFACE -Werror)
endif()
# Without this a compiler may fuse a*b+c into one rounding, and two compilers bake different bytes.
target_compile_options(overlook_options INTERFACE -ffp-contract=off)
if(OVERLOOK_SANITIZE)
  target_compile_options(overlook_options INTERFACE -fsanitize=${OVERLOOK_SANITIZE} -fno-sanitize-recover=all
                                                   -fno-omit-frame-pointer)
  target_link_options(overlook_options INTERFACE -fsanitize=${OVERLOOK_SANITIZE})
endif()

# overlook_library(NAME SOURCES... [PUBLIC libs...] [PRIVATE libs...])
# A library of Overlook's own. Includes are written from the root of the repository: "formats/container.h".
function(overlook_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  add_library(overlook::${name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES OUTPUT_NAME overlook_${name})  # liboverlook_view.a among all that is installed
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/overlook>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:overlook_options>)
endfunction()

# overlook_command(NAME SOURCES... [PRIVATE libs...])   A command that is installed.
function(overlook_command name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_PRIVATE} overlook_options)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# Where modules are installed, and the way there from the programs: an installed tree may be moved as a whole.
set(OVERLOOK_MODULE_DIR ${CMAKE_INSTALL_LIBDIR}/overlook)
file(RELATIVE_PATH OVERLOOK_MODULES_FROM_PROGRAMS ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/overlook)

# overlook_module(NAME SOURCES... [PRIVATE libs...])
# A library that programs open while they run: NAME.so beside them in the build tree, in OVERLOOK_MODULE_DIR where installed.
# It shows only what its sources mark, and links none of Overlook's static libraries, so that nothing of theirs is there twice.
function(overlook_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PRIVATE" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}
                                           CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE OVERLOOK_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${ARG_PRIVATE} overlook_options)
  install(TARGETS ${name} LIBRARY DESTINATION ${OVERLOOK_MODULE_DIR})
endfunction()

# overlook_opens_modules(LIBRARY MODULES...)   LIBRARY opens the modules: whoever links it has them built.
function(overlook_opens_modules library)
  target_compile_definitions(${library} PRIVATE OVERLOOK_VERSION="${PROJECT_VERSION}"
                                                OVERLOOK_MODULES_FROM_PROGRAMS="${OVERLOOK_MODULES_FROM_PROGRAMS}")
  add_dependencies(${library} ${ARGN})
endfunction()
