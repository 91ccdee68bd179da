/// `--keep all` of rows that another run wrote: they have columns that the rows of this one have, too.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/engine.hpp"

namespace barycert::jobs {

/// Which of the columns that could be carried through have names that the rows do not have themselves.
std::vector<bool> columns_to_keep(const Engine& engine, const TableFormat& format,
                                  const std::vector<ColumnFormat>& carried);

/// Takes out those that are not kept, and says so.
Note leave_out(const std::vector<bool>& kept, std::vector<ColumnFormat>& carried, const std::string& file);

/// Gives `sink` rows without these columns.
std::unique_ptr<TableSink> rows_without(const std::vector<bool>& kept, std::unique_ptr<TableSink> sink);

}  // namespace barycert::jobs
