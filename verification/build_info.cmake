# Run at every build, so that the commit in the provenance is that of the sources built; the header changes, and with
# it one object, only when a fact does.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT COMMIT)
  set(COMMIT unknown)
endif()
configure_file(${SOURCE}/verification/build_info.hpp.in ${OUTPUT} @ONLY)
