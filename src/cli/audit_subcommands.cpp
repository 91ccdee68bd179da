// The subcommands of barycert-audit, which `./run audit` builds: without those that need the whole library.
#include "command.hpp"

namespace barycert::cli {

void add_subcommands(const Options& program) {
    add_audit(program);
    add_gaps(program);
    add_search(program);
    add_replay(program);
    add_catalogue(program);
}

}  // namespace barycert::cli
