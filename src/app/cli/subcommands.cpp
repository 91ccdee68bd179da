// The subcommands of barycert, in the order of its help. barycert-audit and barycert-check have those alone that they
// are named after.
#include "app/cli/command.hpp"
#include "app/options/command_table.hpp"

namespace barycert::cli {

void prepare_subcommands() {
#ifdef BARYCERT_AUDIT_COMMANDS
    prepare_for_want_of_memory();
#endif
}

void add_words([[maybe_unused]] Vocabulary& words) {
#ifdef BARYCERT_AUDIT_COMMANDS
    add_audit_words(words);
#endif
}

void add_subcommands(const Options& program) {
#ifdef BARYCERT_AUDIT_COMMANDS
    add_audit(program);
    add_gaps(program);
#endif
#ifdef BARYCERT_CHECK_COMMAND
    add_check(program);
#endif
#ifdef BARYCERT_OTHER_COMMANDS
    add_sample(program);
    add_resample(program);
    add_verify(program);
    add_render(program);
#endif
#ifdef BARYCERT_AUDIT_COMMANDS
    add_search(program);
    add_replay(program);
    add_catalogue(program);
#endif
}

}  // namespace barycert::cli
