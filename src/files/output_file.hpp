/// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"

namespace barycert::base {

/// For the main function of a program: from now on SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE and SIGXCPU first remove
/// the unfinished files of this process and then end it as they would have. A signal that is ignored stays ignored.
/// `tell`: SIGINT, SIGTERM and SIGHUP say on stderr that they ended it. A library must not call it.
void remove_begun_files_on_signals(bool tell = false);

/// Removes the unfinished files of this process that have names, for a program that ends without its destructors.
void remove_begun_files() noexcept;

struct BegunName;

/// The path with its links resolved, also where the last of them leads to a file that does not exist yet.
std::string resolved_path(std::string path);

/// Writes to a file without a name in the target's folder, which commit() puts in the target's place: a process that is
/// ended by whatever means, SIGKILL included, leaves the target as it was and nothing else. Without a commit() the
/// destructor leaves nothing either. The first error is kept, and told by close() and commit().
///
/// Where the file system knows no nameless files (O_TMPFILE), the file is TARGET.tmp-<process>-<count> until the
/// commit; an existing target is replaced by way of such a name in the last moment, too. A program that has called
/// remove_begun_files_on_signals() leaves these names under no signal but SIGKILL.
///
/// A link is followed and stays a link; an existing target keeps its permissions. A device or pipe (/dev/stdout)
/// cannot be replaced, so there the bytes go straight to it. A file that the run under way reads (RunFiles) is
/// never replaced: that is an error from the beginning or, where it was opened later, of the commit.
class OutputFile {
public:
    explicit OutputFile(std::string target);

    /// The standard output, whatever it is: the bytes go straight to it, and it stays open.
    static OutputFile standard_output() { return {}; }

    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);

    /// True if bytes can be replaced before the commit: not for a device, a pipe or the standard output.
    bool can_replace() const { return nameless_ || begun_ != nullptr; }

    /// Replaces bytes from `offset` on, as a count in a header; writes go on at the end. Requires: can_replace().
    void replace(std::uint64_t offset, std::string_view bytes);

    /// The first error so far. Bytes are gathered, so that an error may show only at a later call.
    Status status() const;

    /// Hands all to the system; the target stays. For files that change together, close() all, then commit() them if
    /// all is well.
    Status close();

    /// close() if that is still to do, then the rename.
    Status commit();

private:
    OutputFile();
    void fail(const char* what, int error_number);
    void refuse_input();
    bool open_nameless();
    void open_beside();
    void forget_name();
    bool give_name();
    void flush();
    void put(std::string_view bytes, std::optional<std::size_t> offset = {});

    std::string target_;          // as the caller named it: for messages
    std::string real_path_;       // with links resolved
    BegunName* begun_ = nullptr;  // the name of the unfinished file, while it has one
    std::string buffer_;
    Descriptor file_;
    bool nameless_ = false;       // the unfinished file has no name, and lives while its descriptor is open
    std::optional<Error> error_;  // the first one
};

}  // namespace barycert::base
