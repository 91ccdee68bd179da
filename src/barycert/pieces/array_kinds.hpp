/// The arrays that ranks have at points, and what all of them have.
#pragma once

#include <string>
#include <vector>

#include "barycert/pieces/exchange.hpp"

namespace barycert::pieces {

struct ArrayKind {
    std::string name;
    bool named = true;
    int type = 0;  ///< a number of the engine's
    std::string type_name;
    int components = 1;
    int role = -1;  ///< a number of the engine's; -1: none
    std::vector<std::string> component_names = {};

    /// Name, number of components and type, for messages.
    std::string text() const;
};

/// All call it. `kinds` become those of the lowest rank that has cells; ranks without cells need not have them. An
/// Error if a rank that has cells has others, whatever their order.
Status agree_on_arrays(Exchange& exchange, bool has_cells, std::vector<ArrayKind>& kinds);

}  // namespace barycert::pieces
