// Comma, semicolon, tab and blank separated text (RFC 4180 quoting, by libcsv).
#pragma once

#include "Formats/Text/TextTable.h"

namespace msi
{

// Lines that begin with # and rows without any text are left out. Columns that are empty from the
// header down, as spreadsheets leave them at the right, too. 'text' is the content of the file without
// byte order mark. Cells are without blanks around them.
//
// The delimiter is decided by the first line: tab, else semicolon (with decimal comma), else comma,
// else blanks. Errors: FormatError for a quote inside an unquoted field or a quoted field without end.
TextTable parseDelimitedText(const std::string& file, const std::string& text);

} // namespace msi
