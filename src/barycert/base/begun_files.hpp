/// Names that a process has given to unfinished files, removed when a signal ends it.
///
/// Most unfinished files have no name at all (see output_file.hpp). A name exists where the file system knows no
/// nameless files, and for the moment in which a finished file replaces an older one.
#pragma once

#include <atomic>
#include <string>

namespace barycert::base {

/// For the main function of a program: from now on SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE and SIGXCPU first remove
/// the unfinished files of this process and then end it as they would have. A signal that is ignored stays ignored.
/// `tell`: SIGINT, SIGTERM and SIGHUP say on stderr that they ended it. A library must not decide about signals, so
/// nothing else calls this.
void remove_begun_files_on_signals(bool tell = false);

/// Removes the unfinished files of this process that have names, for a program that ends without its destructors.
void remove_begun_files() noexcept;

/// One name, on record from before the file exists until it is renamed or removed. Safe to use from any thread.
class BegunFile {
public:
    explicit BegunFile(std::string path);
    ~BegunFile() { forget(); }
    BegunFile(const BegunFile&) = delete;
    BegunFile& operator=(const BegunFile&) = delete;

    const std::string& path() const;
    /// The name is gone, or belongs to a finished file.
    void forget();

    struct Record;

private:
    Record* record_;
};

}  // namespace barycert::base
