/* A user's kernel that is right and, in about one case of 32, does what UNRULY says: each an accident that an audit has
 * to survive and to name. */
#define _GNU_SOURCE
#include <fenv.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "barycert/kernel.h"
#include "signed_volumes.h"

#define QUIET 0
#define CRASH 1
#define EXIT 2
#define HANG 3
#define AFTER 4
#define BEFORE 5
#define INPUT 6
#define READ_AFTER 7
#define ROUND 8
#define FLUSH 9
#define PRINT 10
#define STACK 11
#define ALWAYS 12
#define LOADING 13
#define RULE 14
#define LOADED_FLUSH 15
#define SLOW 16
#define RAISE 17
#define ONCE 18
#define SLOW_LOADING 19
#define SLOW_PRINT 20
#define FORK 21
#define ORPHAN 22
#define LEAK 23
#define TRIANGLE 24 /* always crashes */
#define FORKS 25    /* and both go on, likewise in the next ones */
#define FORKS_ALWAYS 26
#define CLONES 27 /* not through the library's fork() */
#define SPINNER 28
#define DAEMON 29
#define SPAWN 30
#define DEAF 31
#define HOARD 32
#define CLOSE 33
#define LIMITS 34
#define GROUP 35
#define CALLED_DAEMON 36
#define LATER 37 /* crashes, but not in the first call */
#define ESCAPE 38 /* leaves a process of its own session, and kills its parent */

void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = "unruly";
    info->simplex = UNRULY == TRIANGLE ? "triangle" : "tetrahedron";
}

#if UNRULY == LOADED_FLUSH
__attribute__((constructor)) static void flush(void) {
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8000);
}
#endif

#if UNRULY == LOADING
__attribute__((constructor)) static void crash(void) {
    abort();
}
#endif

#if UNRULY == SLOW_LOADING
__attribute__((constructor)) static void load(void) {
    usleep(500000);
}
#endif

/* The tests know this condition as well. */
static int unruly(const double* point) {
    unsigned long long bits;
    memcpy(&bits, point, sizeof bits);
    return (bits ^ (bits >> 11) ^ (bits >> 23)) % 32 == 0;
}

/* A process as a program makes it that does not call the library's fork(). */
static int clone_this(void) {
    return (int)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
}

/* Nothing but SIGKILL ends what calls this. */
static void spin_deaf(void) {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, 0);
    for (;;) pause();
}

#if UNRULY == STACK
static int dig(volatile int depth) {
    volatile char room[4096];
    room[0] = (char)depth;
    return dig(depth + 1) + room[0];
}
#endif

int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
#if UNRULY == TRIANGLE
    abort();
#endif
#if UNRULY == LATER
    static int calls;
    ++calls;
#endif
    signed_volumes(vertices, point, weights);
    if (unruly(point)) {
#if UNRULY == CRASH
        raise(SIGFPE);
#elif UNRULY == EXIT
        exit(3);
#elif UNRULY == HANG
        for (;;) pause();
#elif UNRULY == SLOW
        usleep(150000);
#elif UNRULY == AFTER
        weights[4] = 1;
#elif UNRULY == BEFORE
        for (int i = 1; i <= 8; ++i) weights[-i] = 1;
#elif UNRULY == INPUT
        ((double*)vertices)[0] = 0;
#elif UNRULY == READ_AFTER
        weights[0] += 0 * vertices[12];
#elif UNRULY == ROUND
        fesetround(FE_UPWARD);
#elif UNRULY == FLUSH
        __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8000);
#elif UNRULY == PRINT
        printf("point %g\n", point[0]);
#elif UNRULY == RAISE
        raise(SIGSEGV);
#elif UNRULY == ONCE
        static int printed;
        if (!printed++) printf("once\n");
#elif UNRULY == SLOW_PRINT
        printf("slow\n");
#elif UNRULY == STACK
        weights[0] += dig(0);
#elif UNRULY == FORK
        static int forked;
        if (!forked++) fork(); /* and both go on */
#elif UNRULY == ORPHAN
        if (fork() == 0) {
            sleep(20);
            _exit(0);
        }
        raise(SIGFPE);
#elif UNRULY == LEAK
        *(volatile char*)malloc((size_t)1 << 30) = 1;
#elif UNRULY == FORKS
        fork();
#elif UNRULY == CLONES
        clone_this();
#elif UNRULY == SPINNER
        if (clone_this() == 0) for (;;) {
            }
#elif UNRULY == DAEMON
        if (clone_this() == 0) {
            setsid();
            if (clone_this() == 0) spin_deaf();
            _exit(0);
        }
        usleep(1000);
#elif UNRULY == SPAWN
        system("sleep 1000 & sleep 1000 &");
#elif UNRULY == CALLED_DAEMON
        daemon(0, 0);
#elif UNRULY == DEAF
        spin_deaf();
#elif UNRULY == HOARD
        /* All the memory that the machine has, without using any. */
        size_t page = (size_t)sysconf(_SC_PAGESIZE), most = (size_t)sysconf(_SC_PHYS_PAGES) * page, got;
        for (got = 0; got < most; got += (size_t)1 << 28) *(volatile char*)malloc((size_t)1 << 28) = 1;
#elif UNRULY == CLOSE
        int d;
        for (d = 3; d < 1024; ++d) close(d);
#elif UNRULY == LIMITS
        const struct rlimit none = {0, 0};
        setrlimit(RLIMIT_NOFILE, &none);
        setrlimit(RLIMIT_NPROC, &none);
        setrlimit(RLIMIT_DATA, &none);
        setrlimit(RLIMIT_FSIZE, &none);
#elif UNRULY == LATER
        if (calls > 1) abort();
#elif UNRULY == ESCAPE
        if (clone_this() == 0) {
            setsid();
            spin_deaf();
        }
        usleep(1000);
        kill(getppid(), SIGKILL);
        pause();
#elif UNRULY == GROUP
        kill(0, SIGKILL);
#endif
    }
#if UNRULY == SLOW_PRINT
    usleep(300000);
#endif
#if UNRULY == FORKS_ALWAYS
    fork();
#endif
#if UNRULY == ALWAYS
    abort();
#endif
    return 0;
}

#if UNRULY == RULE
/* A tolerance of its own, and a value that is one too large. */
int barycert_kernel_classify(const double* vertices, const double* point, const double* weights) {
    int i;
    (void)vertices;
    (void)point;
    for (i = 0; i < 4; ++i) {
        if (weights[i] < -0.25) return BARYCERT_OUTSIDE;
    }
    return BARYCERT_INTERIOR;
}

double barycert_kernel_value(const double* vertices, const double* point, const double* values) {
    double weights[4], sum = 1;
    int i;
    barycert_kernel_weights(vertices, point, weights);
    for (i = 0; i < 4; ++i) sum += weights[i] * values[i];
    return sum;
}
#endif
