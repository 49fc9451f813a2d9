# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# Builds a roadmap of MAP, checks it against A* through the ESDF, and has the oracle judge its paths.
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message(STATUS "${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()
run("${PROGRAM}" build "${MAP}" -o "${WORK_DIR}/map.ridge" --min-clearance 0.3)
run("${PROGRAM}" check "${WORK_DIR}/map.ridge" --queries 100 --seed 11
    --paths "${WORK_DIR}/paths.json")
run("${ORACLE}" "${MAP}" "${WORK_DIR}/paths.json")
