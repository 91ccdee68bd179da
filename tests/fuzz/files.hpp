/// Inputs as files, for readers take files: in memory (a tmpfs) where there is one, and opened once.
#pragma once

#include <string>
#include <string_view>

namespace barycert::fuzz {

/// One file of the process, at a path that ends in `name`, in a folder of its own that is gone with the process.
class InputFile {
public:
    explicit InputFile(const std::string& name);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Replaces all that is in it. The file is there from then on.
    const std::string& put(std::string_view bytes);

    /// It is there no more.
    void remove();

    const std::string& path() const { return path_; }

private:
    std::string path_;
    int descriptor_ = -1;
    std::size_t size_ = 0;
};

/// A path in the same folder.
std::string scratch_path(const std::string& name);

/// Removes what is there, and returns the path: to write where nothing is takes the system less than to replace.
const std::string& without_file(const std::string& path);

/// All bytes of a file that must be there.
std::string bytes_of(const std::string& path);

/// The next of the parts of an input of several files: up to the next form feed, which is taken off, too.
std::string_view next_part(std::string_view& input);

}  // namespace barycert::fuzz
