# SPDX-License-Identifier: BSD-3-Clause
include_guard()

add_library(gigaray_warnings INTERFACE)
target_compile_options(gigaray_warnings INTERFACE -Wall -Wextra -Wno-unused-parameter
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 sees overlaps in std::string that are not there
if(GIGARAY_DEVELOPER_MODE)
  target_compile_options(gigaray_warnings INTERFACE -Werror)
endif()

# gigaray_precompile(TARGET HEADER ...)
# With GIGARAY_PRECOMPILED_HEADERS: what most files of the target include, and more of it. Off by
# default: ccache knows nothing of such files, and a file that includes too little would pass.
function(gigaray_precompile target)
  if(GIGARAY_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE <Eigen/Geometry> <algorithm> <cmath> <filesystem>
      <functional> <map> <memory> <optional> <string> <vector> ${ARGN})
  endif()
endfunction()

# gigaray_add_library(NAME SOURCES ... DEPENDS ... PRIVATE_DEPENDS ... DIRECTORIES ...)
# One layer: target gigaray_NAME with alias gigaray::NAME, every header under include/ of the layer and
# of DIRECTORIES. Beside it, unless GIGARAY_SHARED is off, gigaray::NAME_shared of the same objects,
# of which only what GIGARAY_API opens is seen.
# Contraction is off so that the plain C++ reference gives the same bits everywhere.
function(gigaray_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS;DIRECTORIES" ${ARGN})
  add_library(gigaray_${name} STATIC ${ARG_SOURCES})
  add_library(gigaray::${name} ALIAS gigaray_${name})
  set_target_properties(gigaray_${name} PROPERTIES EXPORT_NAME ${name}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    VERIFY_INTERFACE_HEADER_SETS ON)  # each header alone: all_verify_interface_header_sets
  target_compile_features(gigaray_${name} PUBLIC cxx_std_20)
  target_compile_options(gigaray_${name} PRIVATE -ffp-contract=off)
  set(directories ${CMAKE_CURRENT_SOURCE_DIR}/include ${ARG_DIRECTORIES})
  set(headers "")
  foreach(directory ${directories})
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${directory}/*.h)
    list(APPEND headers ${found})
  endforeach()
  target_sources(gigaray_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${directories} FILES ${headers})
  target_link_libraries(gigaray_${name}
    PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS} $<BUILD_INTERFACE:gigaray_warnings>)
  set_property(GLOBAL APPEND PROPERTY GIGARAY_LIBRARIES gigaray_${name})
  if(GIGARAY_SHARED)
    gigaray_add_shared_library(${name} "${ARG_DEPENDS}" "${ARG_PRIVATE_DEPENDS}")
  endif()
endfunction()

# The whole of gigaray_NAME as a shared library. Its layers below are the shared ones.
function(gigaray_add_shared_library name depends private_depends)
  set(shared gigaray_${name}_shared)
  set(empty ${CMAKE_CURRENT_BINARY_DIR}/${shared}.cpp)
  file(CONFIGURE OUTPUT ${empty} CONTENT "// All of it comes from the archive.\n")
  add_library(${shared} SHARED ${empty})
  add_library(gigaray::${name}_shared ALIAS ${shared})
  set_target_properties(${shared} PROPERTIES EXPORT_NAME ${name}_shared OUTPUT_NAME gigaray_${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    LINK_DEPENDS $<TARGET_FILE:gigaray_${name}>
    INSTALL_RPATH "$ORIGIN" INSTALL_RPATH_USE_LINK_PATH ON)  # its layers lie beside it
  target_compile_features(${shared} PUBLIC cxx_std_20)
  target_include_directories(${shared}
    INTERFACE $<BUILD_INTERFACE:$<TARGET_PROPERTY:gigaray_${name},INTERFACE_INCLUDE_DIRECTORIES>>
              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  add_dependencies(${shared} gigaray_${name})
  list(TRANSFORM depends REPLACE "^gigaray::(.*)$" "gigaray::\\1_shared")
  target_link_options(${shared} PRIVATE
    LINKER:--whole-archive,$<TARGET_FILE:gigaray_${name}>,--no-whole-archive
    LINKER:--no-undefined LINKER:--as-needed)
  target_link_libraries(${shared} PUBLIC ${depends} PRIVATE ${private_depends})
  set_property(GLOBAL APPEND PROPERTY GIGARAY_SHARED_LIBRARIES ${shared})
endfunction()
