# libcsv (comma-separated values) as LibCsv::LibCsv. Debian ships it without a pkg-config or CMake file.
include_guard(GLOBAL)
find_path(LIBCSV_INCLUDE_DIR csv.h REQUIRED)
find_library(LIBCSV_LIBRARY csv REQUIRED)
mark_as_advanced(LIBCSV_INCLUDE_DIR LIBCSV_LIBRARY)
add_library(LibCsv::LibCsv UNKNOWN IMPORTED GLOBAL)
set_target_properties(LibCsv::LibCsv PROPERTIES IMPORTED_LOCATION "${LIBCSV_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                                                                                      "${LIBCSV_INCLUDE_DIR}")
