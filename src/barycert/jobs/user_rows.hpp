/// Rows as users know them: cells by the numbers that they have in their file, and the labels of the owners.
#pragma once

#include <memory>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/engine.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"

namespace barycert::jobs {

/// The columns of rows: those of the engine, labels that the job asked for, and `carried` ones. Error: a column that is
/// carried through has the name of another one.
Result<TableFormat> user_format(const Engine& engine, TableFormat format, std::vector<ColumnFormat> carried);

/// Takes rows whose cells are those of the mesh of the engine, and gives the sink what users are to see. The engine
/// must stay. The sink itself where that is the same; nullptr stays nullptr.
std::unique_ptr<TableSink> user_rows(const Engine& engine, std::unique_ptr<TableSink> sink);

}  // namespace barycert::jobs
