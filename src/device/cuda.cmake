# The compiler of graphics processors: WHIPPLE_HAS_CUDA, WHIPPLE_NVCC, WHIPPLE_CUDART, and how the kernels are compiled.
set(WHIPPLE_CUDA AUTO CACHE STRING "Kernels for graphics processors: AUTO (if nvcc 12 or later is found), ON, OFF")
set(WHIPPLE_CUDA_ARCHITECTURE 90 CACHE STRING "Compute capability of the graphics processor (90: H100, H200)")
set(WHIPPLE_HAS_CUDA OFF)
if(NOT WHIPPLE_CUDA STREQUAL "OFF")
  find_program(WHIPPLE_NVCC nvcc PATHS /usr/local/cuda/bin)
  if(WHIPPLE_NVCC)
    execute_process(COMMAND ${WHIPPLE_NVCC} --version OUTPUT_VARIABLE whipple_nvcc_version)
    if(whipple_nvcc_version MATCHES "release ([0-9]+)" AND CMAKE_MATCH_1 GREATER_EQUAL 12)
      set(WHIPPLE_HAS_CUDA ON)
    endif()
  endif()
  if(WHIPPLE_CUDA STREQUAL "ON" AND NOT WHIPPLE_HAS_CUDA)
    message(FATAL_ERROR "WHIPPLE_CUDA=ON: nvcc 12 or later was not found")
  endif()
endif()
if(WHIPPLE_HAS_CUDA)
  get_filename_component(whipple_cuda_folder ${WHIPPLE_NVCC} REALPATH)
  get_filename_component(whipple_cuda_folder ${whipple_cuda_folder}/../.. ABSOLUTE)
  find_library(WHIPPLE_CUDART cudart_static PATHS ${whipple_cuda_folder}/lib64 ${whipple_cuda_folder}/targets/x86_64-linux/lib REQUIRED)
endif()

# whipple_gpu_objects(ROOT): sets whipple_gpu_objects to the objects of all kernels, made from the sources under ROOT: those
# of three dimensions (gpu) and of two (gpu_section). Beside each lies a log, which says how many registers each kernel
# takes (scripts/device_registers.py).
set(whipple_device_folder ${CMAKE_CURRENT_LIST_DIR})
function(whipple_gpu_objects root)
  set(objects)
  foreach(part gpu gpu_section)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${part}.o)
    set(log ${CMAKE_CURRENT_BINARY_DIR}/${part}.log)
    add_custom_command(
      OUTPUT ${object}
      BYPRODUCTS ${log}
      COMMAND ${CMAKE_COMMAND} -DLOG=${log} -P ${whipple_device_folder}/keep_log.cmake --
              ${CMAKE_CUDA_COMPILER_LAUNCHER} ${WHIPPLE_NVCC} -std=c++20 -O3 -arch=sm_${WHIPPLE_CUDA_ARCHITECTURE}
              --expt-relaxed-constexpr --expt-extended-lambda -Xcompiler=-march=x86-64-v3,-fPIC -Xptxas=-v,-warn-spills
              -I${root} -MD -MF ${object}.d -c ${whipple_device_folder}/${part}.cu -o ${object}
      DEPFILE ${object}.d
      DEPENDS ${whipple_device_folder}/${part}.cu
      COMMENT "Building kernels for the graphics processor: ${part}" VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  set(whipple_gpu_objects ${objects} PARENT_SCOPE)
endfunction()
