/* Preloaded into a program under test. Counts its calls of the system from main on, and makes one of them fail:
 *   FAULT=KIND:N        the N-th call of a kind (from 1) fails; KIND:N+ that one and all after it
 *   FAULT_ERROR=E       with this errno; without it, with one that is usual for the kind. "short": a read or write
 *                       moves fewer bytes than asked for, which is no failure
 *   FAULT_LOG=FILE      gets a line when a call has failed
 *   FAULT_COUNTS=FILE   gets a line "KIND COUNT" a kind when the program ends
 *   FAULT_FORKED=1      processes that it forks count on from where it was, and fail likewise; else they are let be */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind {
    k_open,
    k_status,
    k_read,
    k_write,
    k_resize,
    k_rename,
    k_close,
    k_map,
    k_memory,
    k_thread,
    k_process,
    kinds
};
static const char* const names[kinds] = {"open",  "status", "read",   "write",  "resize", "rename",
                                         "close", "map",    "memory", "thread", "process"};
static const int usual[kinds] = {EMFILE, EACCES, EIO, ENOSPC, EFBIG, EACCES, EIO, ENOMEM, ENOMEM, EAGAIN, EAGAIN};

static atomic_long counts[kinds];
static int armed, own_process, failing_kind = -1, error_number, moves_fewer, and_after;
static long failing;
static const char *counts_file, *log_file;

static void say(const char* file, const char* text, size_t size) {
    if (file == NULL) return;
    const int descriptor = (int)syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) return;
    (void)!syscall(SYS_write, descriptor, text, size);
    syscall(SYS_close, descriptor);
}

/* True if this call is the one. */
static int fails(enum kind kind) {
    if (!armed || getpid() != own_process) return 0;
    const long now = atomic_fetch_add(&counts[kind], 1) + 1;
    if ((int)kind != failing_kind || (now != failing && !(and_after && now > failing))) return 0;
    if (now == failing) say(log_file, "failed\n", 7);
    errno = error_number;
    return 1;
}

static void tell_counts(void) {
    if (getpid() != own_process) return;
    armed = 0;
    char text[512];
    int size = 0;
    for (int k = 0; k < kinds; ++k)
        size += snprintf(text + size, sizeof text - (size_t)size, "%s %ld\n", names[k], (long)counts[k]);
    say(counts_file, text, (size_t)size);
}

static void arm(void) {
    const char* const fault = getenv("FAULT");
    const char* const error = getenv("FAULT_ERROR");
    counts_file = getenv("FAULT_COUNTS");
    log_file = getenv("FAULT_LOG");
    for (int k = 0; fault != NULL && k < kinds; ++k) {
        const size_t length = strlen(names[k]);
        if (strncmp(fault, names[k], length) != 0 || fault[length] != ':') continue;
        failing_kind = k;
        failing = atol(fault + length + 1);
        and_after = fault[strlen(fault) - 1] == '+';
        error_number = usual[k];
    }
    moves_fewer = error != NULL && strcmp(error, "short") == 0;
    if (error != NULL) error_number = atoi(error);
    own_process = getpid();
    atexit(tell_counts);
    armed = 1;
}

/* The function of the library behind this one. */
#define NEXT(type, name) (__extension__(type) dlsym(RTLD_NEXT, name))

static int (*real_main)(int, char**, char**);
static int armed_main(int argc, char** argv, char** environment) {
    arm();
    return real_main(argc, argv, environment);
}

typedef int start(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
int __libc_start_main(int (*program)(int, char**, char**), int argc, char** argv, void (*begin)(void),
                      void (*end)(void), void (*loader_end)(void), void* stack) {
    real_main = program;
    start* const real = NEXT(start*, "__libc_start_main");
    return real(armed_main, argc, argv, begin, end, loader_end, stack);
}

/* Files. */

static int open_mode(int flags, va_list more) {
    return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(more, int) : 0;
}
#define OPENS(name)                                                   \
    int name(const char* path, int flags, ...) {                      \
        va_list more;                                                 \
        va_start(more, flags);                                        \
        const int mode = open_mode(flags, more);                      \
        va_end(more);                                                 \
        if (fails(k_open)) return -1;                                 \
        return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode); \
    }
OPENS(open)
OPENS(open64)

typedef FILE* opens_stream(const char*, const char*);
#define OPENS_STREAM(name)                                     \
    FILE* name(const char* path, const char* how) {            \
        opens_stream* const real = NEXT(opens_stream*, #name); \
        return fails(k_open) ? NULL : real(path, how);         \
    }
OPENS_STREAM(fopen)
OPENS_STREAM(fopen64)

int memfd_create(const char* name, unsigned flags) {
    return fails(k_open) ? -1 : (int)syscall(SYS_memfd_create, name, flags);
}

int stat(const char* path, struct stat* to) {
    return fails(k_status) ? -1 : (int)syscall(SYS_newfstatat, AT_FDCWD, path, to, 0);
}
int fstat(int descriptor, struct stat* to) {
    return fails(k_status) ? -1 : (int)syscall(SYS_fstat, descriptor, to);
}
int access(const char* path, int how) {
    return fails(k_status) ? -1 : (int)syscall(SYS_faccessat, AT_FDCWD, path, how);
}
int fchmod(int descriptor, mode_t mode) {
    return fails(k_status) ? -1 : (int)syscall(SYS_fchmod, descriptor, mode);
}

static size_t fewer(size_t size) {
    return size > 1 ? size / 2 : size;
}
/* A call that moves bytes: -1, or how many it may move. */
static ssize_t may_move(enum kind kind, size_t size) {
    if (!fails(kind)) return (ssize_t)size;
    return moves_fewer ? (ssize_t)fewer(size) : -1;
}

ssize_t read(int descriptor, void* bytes, size_t size) {
    const ssize_t some = may_move(k_read, size);
    return some < 0 ? -1 : syscall(SYS_read, descriptor, bytes, some);
}
ssize_t pread(int descriptor, void* bytes, size_t size, off_t at) {
    const ssize_t some = may_move(k_read, size);
    return some < 0 ? -1 : syscall(SYS_pread64, descriptor, bytes, some, at);
}
ssize_t pread64(int descriptor, void* bytes, size_t size, off64_t at) {
    return pread(descriptor, bytes, size, at);
}
ssize_t write(int descriptor, const void* bytes, size_t size) {
    const ssize_t some = may_move(k_write, size);
    return some < 0 ? -1 : syscall(SYS_write, descriptor, bytes, some);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
    const ssize_t some = may_move(k_write, size);
    return some < 0 ? -1 : syscall(SYS_pwrite64, descriptor, bytes, some, at);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
    return pwrite(descriptor, bytes, size, at);
}
ssize_t writev(int descriptor, const struct iovec* parts, int count) {
    if (!fails(k_write)) return syscall(SYS_writev, descriptor, parts, count);
    return moves_fewer ? syscall(SYS_write, descriptor, parts[0].iov_base, fewer(parts[0].iov_len)) : -1;
}
off_t lseek(int descriptor, off_t at, int from) {
    return fails(k_status) ? -1 : syscall(SYS_lseek, descriptor, at, from);
}
int ftruncate(int descriptor, off_t size) {
    return fails(k_resize) ? -1 : (int)syscall(SYS_ftruncate, descriptor, size);
}

int rename(const char* from, const char* to) {
    return fails(k_rename) ? -1 : (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    return fails(k_rename) ? -1 : (int)syscall(SYS_linkat, from_folder, from, to_folder, to, flags);
}

/* A file that cannot be closed is closed all the same. */
int close(int descriptor) {
    const int failed = fails(k_close);
    const int error = errno;
    const int result = (int)syscall(SYS_close, descriptor);
    if (!failed) return result;
    errno = error;
    return -1;
}

/* Memory. */

void* mmap(void* at, size_t size, int access, int flags, int descriptor, off_t offset) {
    return fails(k_map) ? MAP_FAILED : (void*)syscall(SYS_mmap, at, size, access, flags, descriptor, offset);
}
void* mmap64(void* at, size_t size, int access, int flags, int descriptor, off64_t offset) {
    return mmap(at, size, access, flags, descriptor, offset);
}

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) {
    return fails(k_memory) ? NULL : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
    return fails(k_memory) ? NULL : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
    return fails(k_memory) ? NULL : __libc_realloc(old, size);
}
void* memalign(size_t to, size_t size) {
    return fails(k_memory) ? NULL : __libc_memalign(to, size);
}
void* aligned_alloc(size_t to, size_t size) {
    return memalign(to, size);
}
int posix_memalign(void** result, size_t to, size_t size) {
    void* const got = memalign(to, size);
    if (got == NULL) return ENOMEM;
    *result = got;
    return 0;
}

/* Threads and processes. */

typedef int creates(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*work)(void*), void* with) {
    creates* const real = NEXT(creates*, "pthread_create");
    return fails(k_thread) ? error_number : real(thread, how, work, with);
}
typedef pid_t forks(void);
pid_t fork(void) {
    forks* const real = NEXT(forks*, "fork");
    if (fails(k_process)) return -1;
    const pid_t child = real();
    if (child == 0 && armed && getenv("FAULT_FORKED") != NULL) own_process = getpid();
    return child;
}
int socketpair(int domain, int type, int protocol, int ends[2]) {
    return fails(k_process) ? -1 : (int)syscall(SYS_socketpair, domain, type, protocol, ends);
}
