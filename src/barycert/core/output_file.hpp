/// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "barycert/core/result.hpp"

namespace barycert {

/// Writes beside the target (TARGET.tmp-<process>-<count>) and renames on commit(), so that a killed run leaves the
/// target as it was. Without a commit() the temporary file is removed by the destructor. Errors (no space, no
/// permission) are kept and told by close() and commit(); the first one counts.
///
/// A link is followed and stays a link; an existing target keeps its permissions. A device or pipe (/dev/stdout)
/// cannot be renamed onto, so there the bytes go straight to it.
class OutputFile {
public:
    explicit OutputFile(std::string target);

    /// The standard output, whatever it is: the bytes go straight to it, and it stays open.
    static OutputFile standard_output();

    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);

    /// True if bytes can be replaced before the commit: not for a device, a pipe or the standard output.
    bool can_replace() const { return !temporary_.empty(); }

    /// Replaces bytes that were written, from byte `offset` on; later writes go on at the end. For what is known only
    /// at the end, such as a count in a header. Precondition: can_replace(), and as many bytes stand there.
    void replace(std::uint64_t offset, std::string_view bytes);

    /// The first error so far. Bytes are gathered, so that an error may show only at a later call.
    Status status() const;

    /// Hands everything to the system but leaves the target as it was. For sets of files that are to change together:
    /// close() all, and commit() only when none has failed.
    Status close();

    /// close() if that is still to do, then the rename.
    Status commit();

private:
    /// Straight to a descriptor that is its own; `error_number` tells why there is none.
    OutputFile(std::string name, int descriptor, int error_number);
    void fail(const char* what, int error_number);
    void open_beside();
    void flush();

    std::string target_;     // as the caller named it: for messages
    std::string real_path_;  // with links resolved
    std::string temporary_;  // empty: nothing to rename or remove
    std::string buffer_;
    int descriptor_ = -1;
    Error error_;
};

}  // namespace barycert
