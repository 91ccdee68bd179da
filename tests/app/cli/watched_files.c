/* Preloaded into a program under test:
 *   WATCHED_NAMES=1       the file system knows no nameless files (O_TMPFILE)
 *   WATCHED_SIGNAL=N      the process (or its parent, with WATCHED_PARENT=1) gets signal N when it has written the
 *                         first bytes of a regular file, and then waits for what comes of it */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

int open(const char* path, int flags, ...) {
    mode_t mode = 0;
    if ((flags & (O_CREAT | O_TMPFILE)) != 0) {
        va_list more;
        va_start(more, flags);
        mode = va_arg(more, mode_t);
        va_end(more);
    }
    if ((flags & O_TMPFILE) == O_TMPFILE && getenv("WATCHED_NAMES") != NULL) {
        errno = EOPNOTSUPP;
        return -1;
    }
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
    const ssize_t written = syscall(SYS_write, descriptor, bytes, size);
    const char* const number = getenv("WATCHED_SIGNAL");
    struct stat status;
    if (number == NULL || written <= 0 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return written;
    if (descriptor <= STDERR_FILENO) return written; /* TetGen's own words go to a file */
    kill(getenv("WATCHED_PARENT") != NULL ? getppid() : getpid(), atoi(number));
    for (int i = 0; i < 100; ++i) usleep(100000);
    return written;
}
