# Read by cpack in a build whose kernels run only on the building machine's processor.
message(FATAL_ERROR "found a build for this machine's processor, expected one for all processors; run cmake --preset release -DCRACKLE_SETS=ALL and build again")
