# Read by cpack in a build that has kernels for its own machine alone.
message(FATAL_ERROR "found a build for this machine's processor, expected one for all: cmake --preset release -DCRACKLE_SETS=ALL, then build again")
