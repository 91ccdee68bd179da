#include "tests/fuzz/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "tests/fuzz/target.hpp"
#include "tests/scratch.hpp"

namespace barycert::fuzz {

std::string scratch_path(const std::string& name) {
    static const test::Scratch folder;
    return folder.path(name);
}

const std::string& without_file(const std::string& path) {
    ::unlink(path.c_str());
    return path;
}

InputFile::InputFile(const std::string& name) : path_(scratch_path(name)) {}

InputFile::~InputFile() {
    remove();
}

const std::string& InputFile::put(std::string_view bytes) {
    if (descriptor_ < 0) {
        descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        size_ = 0;
    }
    const bool written = ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    expect(written && (size_ <= bytes.size() || ::ftruncate(descriptor_, static_cast<off_t>(bytes.size())) == 0),
           "cannot write the input", path_);
    size_ = bytes.size();
    return path_;
}

void InputFile::remove() {
    if (descriptor_ < 0) return;
    ::close(std::exchange(descriptor_, -1));
    ::unlink(path_.c_str());
}

std::string bytes_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    expect(stream.good(), "a file that should be there is not", path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string_view next_part(std::string_view& input) {
    const std::size_t end = input.find('\f');
    const std::string_view part = input.substr(0, end);
    input.remove_prefix(end == std::string_view::npos ? input.size() : end + 1);
    return part;
}

}  // namespace barycert::fuzz
