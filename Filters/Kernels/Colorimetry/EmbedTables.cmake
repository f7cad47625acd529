# Writes the CIE tables into a C++ source: cmake -DOUTPUT=<.cpp> -DTABLES=<.csv>[,<.csv>...] -P
#
# A table is a CSV file of numbers under one header line; its name is the file's name. The source
# defines standardTables(), declared in StandardTables.h.
string(REPLACE "," ";" tables "${TABLES}")
set(arrays "")
set(entries "")
foreach(table IN LISTS tables)
  get_filename_component(name "${table}" NAME_WE)
  string(MAKE_C_IDENTIFIER "${name}" identifier)
  file(STRINGS "${table}" lines)
  list(POP_FRONT lines header)
  string(REGEX MATCHALL "," commas "${header}")
  list(LENGTH commas columns)
  math(EXPR columns "${columns} + 1")
  string(REPEAT ",-?[0-9][-+.0-9eE]*" ${columns} pattern)
  foreach(line IN LISTS lines)
    if(NOT ",${line}" MATCHES "^${pattern}$")
      message(FATAL_ERROR "${table}: '${line}' is not a row of ${columns} numbers")
    endif()
  endforeach()
  list(LENGTH lines rows)
  list(JOIN lines ",\n" values)
  string(APPEND arrays "constexpr double ${identifier}[] = {\n${values}\n};\n\n")
  string(APPEND entries "    { \"${name}\", ${rows}, ${columns}, ${identifier} },\n")
endforeach()
file(WRITE "${OUTPUT}.new" "// Written by EmbedTables.cmake from Data/Tables.
#include \"Kernels/Colorimetry/StandardTables.h\"

namespace msi
{

namespace
{
${arrays}}

const std::vector<StandardTable>& standardTables()
{
  static const std::vector<StandardTable> tables{
${entries}  };
  return tables;
}

} // namespace msi
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
