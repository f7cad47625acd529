// A diagnosis as tables that a spreadsheet view and a chart show.
#ifndef GapReportTables_h
#define GapReportTables_h

#include "GapTables.h"

#include "Kernels/Gap/GapReport.h"

class vtkTable;

namespace msi
{

// One row; field data Report: the text of report.json.
void writeSummary(const GapReport& report, vtkTable* table);
// Field data Effects of a table: the correction as the text of an effect list, where there is one.
void writeEffects(
  const GapReport& report, const std::vector<std::string>& channels, vtkTable* table);
// One row an axis (with an empty cell), below it its worst cells.
void writeWhere(const GapReport& report, vtkTable* table);
// One row a parameter, at least one a cause.
void writeCauses(const GapReport& report, vtkTable* table);
void writeCandidates(const GapReport& report, vtkTable* table);
void writeNotes(const GapReport& report, vtkTable* table);

// One row a channel and sample group.
void writeHeatMap(const GapReport& report, const GapCapture& capture, vtkTable* table);
void writeTrend(const GapReport& report, const GapCapture& capture, vtkTable* table);
// The metadata of the samples, and the gap of each.
void writeSamples(
  const GapReport& report, const GapCapture& capture, vtkTable* samples, vtkTable* table);
void writeCorrectedCamera(const GapReport& report, vtkTable* camera, vtkTable* table);

} // namespace msi

#endif
