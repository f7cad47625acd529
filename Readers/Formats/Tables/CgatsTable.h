// CGATS.17 and its relatives (ArgyllCMS .ti3 and .cie, IT8.7).
#pragma once

#include "Formats/Text/TextTable.h"

#include <string_view>

namespace msi
{

bool looksLikeCgats(std::string_view text) noexcept;

// The first table with spectral or response fields, else the first, as a table with a header: the field
// names. SAMPLE_NAME, else SAMPLE_ID, is renamed "sample".
//
// Why not an existing parser: Little CMS 2.14 turns the sample 001 into 1, keeps ten digits of a number
// and has no column to report; ArgyllCMS offers no library.
// Source: ISO 28178 (2009); CGATS.17 annex J.
// Errors: FormatError for a missing section, counts that disagree with NUMBER_OF_FIELDS or
//         NUMBER_OF_SETS, and a file that ends before END_DATA.
TextTable parseCgats(const std::string& file, const std::string& text);

} // namespace msi
