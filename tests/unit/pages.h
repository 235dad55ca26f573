/* pages.h - memory in pages of its own, which can be made unreadable or read-only, and a function
   that tells whether a call touched such a page.  POSIX systems have it; PAGES says whether.  It is
   included before the headers of C, because -std=c99 hides mmap. */
#ifndef PAGES_H
#define PAGES_H
#if defined(__unix__) || defined(__APPLE__)
#define PAGES 1
#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for mmap with -std=c99 */
#endif
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

static sigjmp_buf page_fault;

static void page_handler(int number)
{
    (void)number;
    siglongjmp(page_fault, 1);
}

static size_t page_bytes(size_t bytes)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    return (bytes + page - 1) / page * page;
}

/* Pages that end with the last of so many bytes, a multiple of their alignment, behind a page
   without access. */
static inline void *page_take(size_t bytes)
{
    const size_t used = page_bytes(bytes), page = page_bytes(1);
    char *p = (char *)mmap(NULL, used + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == (char *)MAP_FAILED || mprotect(p, used, PROT_READ | PROT_WRITE)) {
        printf("out of memory\n");
        exit(2);
    }
    return p + used - bytes;
}

static inline void page_free(void *memory, size_t bytes)
{
    munmap((char *)memory + bytes - page_bytes(bytes), page_bytes(bytes) + page_bytes(1));
}

/* access: PROT_NONE, PROT_READ, or PROT_READ | PROT_WRITE */
static inline void page_allow(void *memory, size_t bytes, int access)
{
    if (mprotect((char *)memory + bytes - page_bytes(bytes), page_bytes(bytes), access)) {
        printf("mprotect failed\n");
        exit(2);
    }
}

/* Runs a function; returns 1 if it touched a page that did not allow it, and *result otherwise is
   what the function returned. */
static inline int page_faults(int (*run)(void *), void *argument, int *result)
{
    struct sigaction now, segv, bus;
    int faulted = 1;
    now.sa_handler = page_handler;
    now.sa_flags = SA_NODEFER;
    sigemptyset(&now.sa_mask);
    sigaction(SIGSEGV, &now, &segv);
    sigaction(SIGBUS, &now, &bus);
    if (!sigsetjmp(page_fault, 1)) {
        *result = run(argument);
        faulted = 0;
    }
    sigaction(SIGSEGV, &segv, NULL);
    sigaction(SIGBUS, &bus, NULL);
    return faulted;
}
#else
#define PAGES 0
#endif
#endif
