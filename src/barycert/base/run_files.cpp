#include "barycert/base/run_files.hpp"

#include <sys/stat.h>

namespace barycert::base {
namespace {

thread_local RunFiles* run_of_thread = nullptr;

}  // namespace

RunFiles::RunFiles() : outer_(run_of_thread) {
    run_of_thread = this;
}

RunFiles::~RunFiles() {
    run_of_thread = outer_;
    if (outer_ != nullptr) outer_->inputs_.merge(inputs_);
}

void record_input(int descriptor, const std::string& path) {
    struct stat status {};
    if (run_of_thread == nullptr || ::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
    run_of_thread->inputs_.emplace(std::pair(status.st_dev, status.st_ino), path);
}

const std::string* input_of_run(const std::string& path) {
    struct stat status {};
    if (run_of_thread == nullptr || ::stat(path.c_str(), &status) != 0) return nullptr;
    for (const RunFiles* run = run_of_thread; run != nullptr; run = run->outer_) {
        const auto found = run->inputs_.find({status.st_dev, status.st_ino});
        if (found != run->inputs_.end()) return &found->second;
    }
    return nullptr;
}

}  // namespace barycert::base
