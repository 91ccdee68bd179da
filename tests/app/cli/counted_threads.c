/* Preloaded into a program under test: says on stderr, as its last words, how many threads it has made. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>

static atomic_int made;

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument) {
    int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    *(void**)&create = dlsym(RTLD_NEXT, "pthread_create");
    ++made;
    return create(thread, attributes, run, argument);
}

__attribute__((destructor)) static void tell(void) {
    fprintf(stderr, "threads made: %d\n", made);
}
