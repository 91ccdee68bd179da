// The subcommands of barycert, in the order of its help; of barycert-audit those that do not need the whole library.
#include "command.hpp"

namespace barycert::cli {

void add_subcommands(const Options& program) {
#ifdef BARYCERT_WITH_AUDIT
    add_audit(program);
    add_gaps(program);
#endif
#ifndef BARYCERT_AUDIT_ALONE
    add_check(program);
    add_sample(program);
    add_resample(program);
    add_verify(program);
    add_render(program);
#endif
#ifdef BARYCERT_WITH_AUDIT
    add_search(program);
    add_replay(program);
    add_catalogue(program);
#endif
}

}  // namespace barycert::cli
