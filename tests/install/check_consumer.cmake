# SPDX-License-Identifier: BSD-3-Clause
# Installs BUILD_DIR into a folder of its own, then configures, builds and runs the consumers with it.
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(build consumer)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CONSUMERS_DIR}/${consumer} -B ${WORK_DIR}/${consumer}
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${consumer})
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${prefix}/bin/gigaray --version)
build(consumer)
run(${WORK_DIR}/consumer/consumer ${WORK_DIR}/field.grl)
if(SHARED)
  build(shared_consumer)
  run(${prefix}/bin/gigaray synth garden --path walk -o ${WORK_DIR}/walk --views 5 --width 96 --height 64)
  run(${WORK_DIR}/shared_consumer/shared_consumer ${WORK_DIR}/walk ${WORK_DIR}/walk.ply ${WORK_DIR}/walk.glb)
  execute_process(COMMAND readelf --dynamic --wide ${WORK_DIR}/shared_consumer/shared_consumer
    OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
  if(NOT dynamic MATCHES "libgigaray_workflows\\.so\\.0\\.1")
    message(FATAL_ERROR "the consumer asks for no libgigaray_workflows.so.0.1:\n${dynamic}")
  endif()
  # What no public header declares is hidden.
  file(GLOB engine ${prefix}/lib*/libgigaray_engine.so ${prefix}/lib/*/libgigaray_engine.so)
  execute_process(COMMAND nm --dynamic --defined-only --demangle ${engine}
    OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES "gigaray::Estimator::reconstruct" OR symbols MATCHES "gigaray::Pipeline::")
    message(FATAL_ERROR "libgigaray_engine.so shows what it should not, or hides what it should show")
  endif()
endif()
