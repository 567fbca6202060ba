# SPDX-License-Identifier: BSD-3-Clause
include_guard()

add_library(gigaray_warnings INTERFACE)
target_compile_options(gigaray_warnings INTERFACE -Wall -Wextra -Wno-unused-parameter
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 sees overlaps in std::string that are not there
if(GIGARAY_DEVELOPER_MODE)
  target_compile_options(gigaray_warnings INTERFACE -Werror)
endif()

# gigaray_add_library(NAME SOURCES ... DEPENDS ... PRIVATE_DEPENDS ...)
# One layer: target gigaray_NAME with alias gigaray::NAME, headers under include/.
# Contraction is off so that the plain C++ reference gives the same bits everywhere.
function(gigaray_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(gigaray_${name} STATIC ${ARG_SOURCES})
  add_library(gigaray::${name} ALIAS gigaray_${name})
  set_target_properties(gigaray_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(gigaray_${name} PUBLIC cxx_std_20)
  target_compile_options(gigaray_${name} PRIVATE -ffp-contract=off)
  target_include_directories(gigaray_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(gigaray_${name}
    PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS} $<BUILD_INTERFACE:gigaray_warnings>)
  set_property(GLOBAL APPEND PROPERTY GIGARAY_LIBRARIES gigaray_${name})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
