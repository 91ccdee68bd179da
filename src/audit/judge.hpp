/// Who says what is right: the integers, CGAL, and barycert's own core where it does not sit in judgement on itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "barycert/audit.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert::audit {

/// The core's answer where its filter or its double-double numbers decide: nothing where it would ask its own integers,
/// and nothing for perspective. Same answer as ask_oracle(), in a tenth of the time.
std::optional<OracleAnswer> ask_core(const Case& c);

/// Two oracles that do not say the same of a case.
struct Disagreement {
    std::uint64_t index = 0;    ///< of the case
    std::string first, second;  ///< "the core", "integers", "CGAL"
    OracleAnswer first_answer, second_answer;
    Case c;
};

/// Keeps, of two disagreements, the one in the case of lower index.
inline void keep_first(std::optional<Disagreement>& first, const std::optional<Disagreement>& other) {
    if (other && (!first || other->index < first->index)) first = other;
}

class Judge {
public:
    /// One case of so many that the core decided is put to the integers as well, and one of so many to CGAL.
    static constexpr std::uint64_t integers_share = 16, cgal_share = 256;

    using Oracle = OracleAnswer (*)(const Case&);

    /// `core_may_decide`: no kernel under audit is the core. `cgal` is ask_cgal(), or a test's.
    Judge(OracleChoice choice, bool core_may_decide, Oracle cgal = ask_cgal)
        : choice_(choice), core_(core_may_decide && choice == OracleChoice::automatic), cgal_(cgal) {}

    /// The right answer to case `index`. Who decided and who agreed is added to `counts`; of disagreements the first is
    /// kept, and the answer is then the first oracle's.
    OracleAnswer decide(const Case& c, std::uint64_t index, OracleCounts& counts,
                        std::optional<Disagreement>& disagreement) const;

private:
    OracleChoice choice_;
    bool core_;
    Oracle cgal_;
};

/// The disagreement as an error, with the witness in it.
Error error_of(const Disagreement& d, const std::string& family, std::uint64_t seed);

}  // namespace barycert::audit
