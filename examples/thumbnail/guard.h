/* guard.h - ends the program with one line on stderr and no half-written file, whatever happens:
   the time is up, the user interrupts, a library crashes on a file made to break it.  Without
   POSIX signals only memory and files are watched. */
#ifndef THUMBNAIL_GUARD_H
#define THUMBNAIL_GUARD_H

#include <stdio.h>
#include <string.h>

#if defined(__unix__) || defined(__APPLE__)
#define THUMBNAIL_POSIX
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* The data of the signal handler: the file that is being written, and the work in progress */
static char guard_part[4096];
static const char *volatile guard_doing = "starting";

static void guard_say(const char *text)
{
    size_t n = strlen(text);
    while (n) {
        ssize_t said = write(2, text, n);
        if (said <= 0) return;
        text += said;
        n -= (size_t)said;
    }
}

static void guard_end(int signal_number)
{
    if (guard_part[0]) unlink(guard_part);
    guard_say("thumbnail: ");
    if (signal_number == SIGALRM)
        guard_say("gave up after --max-seconds while ");
    else if (signal_number == SIGINT || signal_number == SIGTERM || signal_number == SIGHUP)
        guard_say("interrupted while ");
    else
        guard_say("crashed while ");
    guard_say(guard_doing);
    guard_say("\n");
    _exit(1);
}

/* Half the machine's memory at most: a file that asks for more is refused, and does not push
   everything else out.  Sanitizers reserve far more than they use. */
static void guard_memory(void)
{
#if defined(_SC_PHYS_PAGES) && !defined(__SANITIZE_ADDRESS__)
    double bytes = 0.5 * (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    struct rlimit limit;
    if (bytes < 1e8 || bytes > 1e15 || getrlimit(RLIMIT_AS, &limit)) return;
    if (limit.rlim_cur == RLIM_INFINITY || (double)limit.rlim_cur > bytes)
        limit.rlim_cur = (rlim_t)bytes;
    setrlimit(RLIMIT_AS, &limit);
#endif
}

static void guard_begin(int max_seconds)
{
    static const int ends[] = { SIGALRM, SIGINT, SIGTERM, SIGHUP, SIGSEGV,
                                SIGBUS,  SIGFPE, SIGILL,  SIGABRT };
    static char stack[65536]; /* the program's own stack may be what overflowed */
    stack_t other = { 0 };
    struct sigaction action = { 0 };
    other.ss_sp = stack;
    other.ss_size = sizeof stack;
    sigaltstack(&other, NULL);
    action.sa_handler = guard_end;
    action.sa_flags = SA_ONSTACK;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) sigaction(ends[i], &action, NULL);
    guard_memory();
    signal(SIGPIPE, SIG_IGN); /* write reports it instead */
    if (max_seconds) alarm((unsigned)max_seconds);
}

static int guard_terminal(void) { return isatty(2); }
#else
static const char *guard_doing;
static void guard_begin(int max_seconds) { (void)max_seconds; }
static int guard_terminal(void) { return 0; }
#endif
#endif
