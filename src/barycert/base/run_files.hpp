/// The files that a run has opened for reading, so that it replaces none of them.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>

namespace barycert::base {

/// A run lasts as long as this lives, on the thread that made it: whatever InputFile, read_file and readers of streams
/// open there is recorded, and an OutputFile refuses to replace it. A run within a run hands on what it has recorded.
/// Without a run nothing is recorded: who reads a file and then writes it by two calls of a library may do so.
class RunFiles {
public:
    RunFiles();
    ~RunFiles();
    RunFiles(const RunFiles&) = delete;
    RunFiles& operator=(const RunFiles&) = delete;

private:
    friend void record_input(int descriptor, const std::string& path);
    friend const std::string* input_of_run(const std::string& path);

    RunFiles* outer_;
    std::map<std::pair<dev_t, ino_t>, std::string> inputs_;  ///< by device and inode, whatever names lead there
};

/// The open file, if it is a regular one, is read by the run of this thread, if there is one.
void record_input(int descriptor, const std::string& path);

/// The path by which the run of this thread has opened the file that `path` leads to; nullptr if it has not.
const std::string* input_of_run(const std::string& path);

}  // namespace barycert::base
