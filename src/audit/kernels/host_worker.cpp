// The process that runs a user's kernel: guard pages around its arrays, and a look at what it left behind.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cfenv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <ratio>

#include "audit/kernels/channel.hpp"
#include "barycert/environment.hpp"
#include "barycert/simplex.hpp"
#include "files/descriptor.hpp"

namespace barycert::kernels {
namespace {

[[noreturn]] void give_up() {
    _exit(127);
}

/// Four arrays, each at the end of a page of its own with a page before and after it that may not be touched. The
/// kernel reads its input through pages that it cannot write to.
class GuardedArrays {
public:
    enum Array : std::size_t { vertices, point, values, weights };

    GuardedArrays() : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
        const int file = memfd_create("arrays", MFD_CLOEXEC);
        if (file < 0 || ftruncate(file, static_cast<off_t>(arrays * page_)) != 0) give_up();
        inner_ = base::map_memory(arrays * page_, PROT_READ | PROT_WRITE, MAP_SHARED, file).release();
        outer_ = base::map_memory(size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS).release();
        if (inner_ == nullptr || outer_ == nullptr) give_up();
        for (std::size_t a = 0; a < arrays; ++a) {
            const int access = a == weights ? PROT_READ | PROT_WRITE : PROT_READ;
            if (mmap(outer_ + (2 * a + 1) * page_, page_, access, MAP_SHARED | MAP_FIXED, file,
                     static_cast<off_t>(a * page_)) == MAP_FAILED)
                give_up();
        }
        close(file);
        std::memset(inner_, filler, arrays * page_);
    }

    /// The last `count` numbers of an array's page: as the kernel gets them, and to write to.
    double* outer(Array a, std::size_t count) const { return end(outer_ + (2 * a + 1) * page_, count); }
    double* inner(Array a, std::size_t count) const { return end(inner_ + a * page_, count); }

    bool holds(const void* address) const {
        const char* const p = static_cast<const char*>(address);
        return p >= outer_ && p < outer_ + size();
    }

    /// One of the 64 bytes in front of `count` weights was written to.
    bool written_before(std::size_t count) const {
        const char* const stop = inner_ + (weights + 1) * page_ - count * sizeof(double);
        return std::any_of(stop - 64, stop, [](char c) { return c != static_cast<char>(filler); });
    }
    void mend_before(std::size_t count) {
        std::memset(inner_ + weights * page_, filler, page_ - count * sizeof(double));
    }

private:
    static constexpr std::size_t arrays = 4;
    static constexpr int filler = 0xa5;
    std::size_t size() const { return (2 * arrays + 1) * page_; }
    double* end(char* page, std::size_t count) const {
        return reinterpret_cast<double*>(page + page_ - count * sizeof(double));
    }
    std::size_t page_;
    char* inner_ = nullptr;
    char* outer_ = nullptr;
};

// For the handler of signals.
Channel* the_channel = nullptr;
const GuardedArrays* the_arrays = nullptr;

/// Notes where the fault was, and ends as if there were no handler. Raised, for a signal that was sent would not come
/// again by itself.
void on_fault(int signal, siginfo_t* info, void*) {
    if (the_arrays != nullptr && info->si_code > 0 && the_arrays->holds(info->si_addr)) the_channel->beside = true;
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // blocked until the handler returns
}

void set_signals() {
    // The server, of which this process is a copy, has done away with the program's handlers, and ignores what the
    // terminal sends: an end by Ctrl-C is no crash of the kernel's.
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    static char stack[1 << 16];  // a kernel may have used up its own
    stack_t alternative{};
    alternative.ss_sp = stack;
    alternative.ss_size = sizeof stack;
    sigaltstack(&alternative, nullptr);
    struct sigaction action {};
    action.sa_sigaction = on_fault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigaction(SIGSEGV, &action, nullptr);
    sigaction(SIGBUS, &action, nullptr);
}

void set_streams(int printed) {
    fcntl(printed, F_SETFL, O_APPEND);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0);
    close(null);
    dup2(printed, 1);
    dup2(printed, 2);
    std::setvbuf(stdout, nullptr, _IONBF, 0);
}

/// Says, in words, how the floating-point environment was changed; nothing if it was not.
const char* changed_environment() {
    if (rounds_correctly()) return nullptr;
    const int rounding = std::fegetround();
    if (rounding == FE_UPWARD) return "rounding upward";
    if (rounding == FE_DOWNWARD) return "rounding downward";
    if (rounding == FE_TOWARDZERO) return "rounding toward zero";
    volatile double small = std::numeric_limits<double>::min();
    small = small / 2;
    if (small == 0) return "subnormal results flushed to zero";
    volatile double subnormal = std::numeric_limits<double>::denorm_min();
    if (subnormal + subnormal == 0) return "subnormal operands taken as zero";
    return "floating-point exceptions or precision changed";
}

/// A mark that the system clears in every process made of this one, by whatever call.
const volatile char* the_original = nullptr;

void mark_original() {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    char* const mark = base::map_memory(page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS).release();
    if (mark == nullptr) give_up();
    madvise(mark, page, MADV_WIPEONFORK);
    *mark = 1;
    the_original = mark;
}

/// Processes that the kernel forks have no part in the answers: by fork() they end there, by other ways here.
void leave_if_forked() {
    if (*the_original == 0) [[unlikely]]
        _exit(0);
}

/// A copy of the descriptor where a library that closes what it did not open would not find it, if there may be one.
int out_of_the_way(int descriptor) {
    const int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, 200);
    return copy >= 0 ? copy : fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
}

class WorkerProcess {
public:
    WorkerProcess(Channel& channel, int printed) : channel_(channel), printed_(printed) { the_arrays = &arrays_; }

    Description load(const char* path) {
        Description d;
        void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        const char* const change = changed_environment();
        ExactEnvironment::renew();
        if (library == nullptr) {
            put(d.error, dlerror());
            return d;
        }
        f_ = LibraryFunctions(library);
        d = f_.described();
        if (change != nullptr) put(d.note, change);
        ExactEnvironment::renew();
        if (d.missing[0] != '\0') return d;
        if (has_printed()) forget_printed();  // a greeting is not an answer's affair
        if (end_children({})) put(d.error, "it starts a process that goes on when it is loaded");
        return d;
    }

    void run() {
        channel_.detail[0] = '\0';
        const std::uint32_t first = channel_.first;
        const auto count = std::min<std::uint32_t>(channel_.count, batch_size);
        ask(first, count);
        char text[sizeof channel_.detail];
        const std::uint8_t unseen = watches_ ? 0 : look_around(text);
        if (unseen != 0) {  // by which case? Look after each, from now on
            watches_ = true;
            channel_.detail[0] = '\0';
            ask(first, count);
            if (seen_ == 0 && first < count) {  // once and never again: by one of these cases
                channel_.answers[first].incidents |= unseen;
                tell(text);
                seen_ = unseen;
            }
        }
        watches_ = seen_ != 0;
        channel_.ns = channel_.timed && count > 0 ? measure(count) : -1;
    }

private:
    void ask(std::uint32_t first, std::uint32_t count) {
        channel_.complete.store(first, std::memory_order_relaxed);
        for (std::uint32_t i = first; i < count; ++i) {
            begin(i);
            channel_.answers[i] = ask(channel_.cases[i]);
            channel_.complete.store(i + 1, std::memory_order_release);
        }
    }

    void begin(std::uint32_t i) {
        channel_.current.store(i, std::memory_order_relaxed);
        channel_.begun.fetch_add(1, std::memory_order_relaxed);
    }

    Answer ask(const Case& c) {
        const auto n = static_cast<std::size_t>(vertex_count(channel_.simplex)),
                   numbers = n * static_cast<std::size_t>(channel_.stride),
                   d = static_cast<std::size_t>(space_dimension(channel_.simplex));
        const double* const vertices = arrays_.outer(GuardedArrays::vertices, numbers);
        const double* const point = arrays_.outer(GuardedArrays::point, d);
        double* const weights = arrays_.outer(GuardedArrays::weights, n);
        std::copy_n(c.vertices.data(), numbers, arrays_.inner(GuardedArrays::vertices, numbers));
        std::copy_n(c.point.data(), d, arrays_.inner(GuardedArrays::point, d));
        double* const inner = arrays_.inner(GuardedArrays::weights, n);
        std::fill_n(inner, n, std::numeric_limits<double>::quiet_NaN());
        Answer a;
        a.status = f_.weights(vertices, point, weights);
        look(a, n);
        std::copy_n(arrays_.inner(GuardedArrays::weights, n), n, a.weights.begin());
        if (a.status == 0 && f_.classify != nullptr) {
            a.region = f_.classify(vertices, point, weights);
            look(a, n);
        }
        if (a.status == 0 && f_.value != nullptr) {
            std::copy_n(c.values.data(), n, arrays_.inner(GuardedArrays::values, n));
            a.value = f_.value(vertices, point, arrays_.outer(GuardedArrays::values, n));
            look(a, n);
        }
        char text[sizeof channel_.detail];
        if (const std::uint8_t beside = watches_ ? look_around(text) : 0) {
            a.incidents |= beside;
            seen_ |= beside;
            tell(text);
        }
        return a;
    }

    /// Notes, and mends, what the function that was just called left behind.
    void look(Answer& a, std::size_t n) {
        leave_if_forked();
        if (!rounds_correctly()) [[unlikely]] {
            a.incidents |= incident_environment;
            tell(changed_environment());
            ExactEnvironment::renew();
        }
        if (arrays_.written_before(n)) [[unlikely]] {
            a.incidents |= incident_beside;
            tell("wrote in front of the weights");
            arrays_.mend_before(n);
        }
    }

    /// Notes, in words too, what was done outside of this process since the last look, and undoes it.
    template <std::size_t room>
    std::uint8_t look_around(char (&words)[room]) const {
        std::uint8_t incidents = 0;
        if (has_printed()) {
            incidents |= incident_printed;
            char text[100] = {};
            const ssize_t got = pread(printed_, text, sizeof text - 1, 0);
            std::snprintf(words, room, "wrote \"%.*s\"", static_cast<int>(std::max<ssize_t>(got, 0)), text);
            forget_printed();
        }
        if (end_children({})) {
            incidents |= incident_forked;
            put(words, "left a process behind");
        }
        return incidents;
    }

    bool has_printed() const {
        struct stat s {};
        if (fstat(printed_, &s) == 0) return s.st_size > 0;
        channel_.closed = true;
        _exit(0);
    }
    void forget_printed() const {
        if (ftruncate(printed_, 0) != 0) give_up();
    }
    void tell(const char* text) {
        if (channel_.detail[0] == '\0') put(channel_.detail, text);
    }

    /// The time of a plain call, without the copying and looking above. Weights go where it is known to do no harm to
    /// write beside them, should the kernel do that.
    double measure(std::uint32_t count) {
        const auto n = static_cast<std::size_t>(vertex_count(channel_.simplex));
        double* const weights = arrays_.outer(GuardedArrays::weights, n);
        const auto start = std::chrono::steady_clock::now();
        for (std::uint32_t i = 0; i < count; ++i) {
            begin(i);
            const Case& c = channel_.cases[i];
            f_.weights(c.vertices.data(), c.point.data(), weights);
            leave_if_forked();
        }
        const auto stop = std::chrono::steady_clock::now();
        ExactEnvironment::renew();
        arrays_.mend_before(n);
        if (watches_) forget_printed();
        end_children({});
        return std::chrono::duration<double, std::nano>(stop - start).count() / count;
    }

    Channel& channel_;
    int printed_;
    GuardedArrays arrays_;
    LibraryFunctions f_;
    std::uint8_t seen_ = 0;  ///< what it has done outside of this process in answer to cases
    bool watches_ = true;    ///< looks around after each case: in the first batch, and once there was something
};

}  // namespace

void run_worker(Channel& channel, int socket, int printed, const char* path) {
    const ExactEnvironment environment;
    the_channel = &channel;
    // A kernel that calls exit() must not end what the program, of which this process is a copy, wants to end itself.
    if (on_exit([](int status, void*) { _exit(status); }, nullptr) != 0) give_up();
    set_signals();
    set_streams(printed);
    const int own_socket = out_of_the_way(socket), own_printed = out_of_the_way(printed);
    if (own_socket < 0 || own_printed < 0) give_up();
    mark_original();
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    if (pthread_atfork(nullptr, nullptr, [] { _exit(0); }) != 0) give_up();
    close(socket);
    close(printed);
    WorkerProcess process(channel, own_printed);
    const Description description = process.load(path);
    for (;;) {
        leave_if_forked();
        char command = 0;
        errno = 0;
        const ssize_t got = read(own_socket, &command, 1);
        if (got < 0 && errno == EINTR) continue;
        if (got != 1) break;
        if (command == static_cast<char>(Command::describe)) {
            channel.description = description;
        } else {
            process.run();
        }
        if (write(own_socket, &command, 1) != 1) break;
    }
    channel.closed = errno == EBADF;
    _exit(0);
}

}  // namespace barycert::kernels
