/* guard.h - ends the program with one line on stderr and no half-written file, whatever happens:
   the time is up, the user interrupts, a library crashes on a file made to break it.  Systems that
   are neither POSIX nor Windows have none of this. */
#ifndef MODEL_GUARD_H
#define MODEL_GUARD_H

#include "options.h"

/* --max-seconds counts processor time.  A program that waits ends after four times as long. */
enum { GUARD_PATIENCE = 4 };

#if defined(__unix__) || defined(__APPLE__)
#define GUARD_POSIX
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

/* The data of the signal handler: the file that is being written, the program that writes it where
   it is another one, and the work in progress */
static char guard_part[4400];
static volatile pid_t guard_child;
static const char *volatile guard_doing = "starting";
static const char *volatile guard_file = ""; /* the file that it reads */
static int guard_lines = 2;                  /* the descriptor that takes the program's lines */
static int guard_status = 1;                 /* the exit status where the program is ended */

static void guard_say(const char *text)
{
    size_t n = strlen(text);
    while (n) {
        ssize_t said = write(guard_lines, text, n);
        if (said <= 0) return;
        text += said;
        n -= (size_t)said;
    }
}

/* A signal from outside ends the program itself, so that a loop of a shell ends with it. */
static void guard_pass_on(int number)
{
    sigset_t only;
    signal(number, SIG_DFL);
    sigemptyset(&only);
    sigaddset(&only, number);
    sigprocmask(SIG_UNBLOCK, &only, NULL);
    raise(number);
}

static void guard_end(int number)
{
    const int crashed = number == SIGSEGV || number == SIGBUS || number == SIGFPE ||
                        number == SIGILL || number == SIGABRT;
    const int late = number == SIGALRM || number == SIGPROF;
    if (guard_child > 0 && !kill(guard_child, SIGKILL)) waitpid(guard_child, NULL, 0);
    if (guard_part[0]) unlink(guard_part);
    guard_say(program_name);
    guard_say(late      ? ": gave up after --max-seconds while "
              : crashed ? ": crashed while "
                        : ": interrupted while ");
    guard_say(guard_doing);
    guard_say(guard_file);
    guard_say("\n");
    if (!crashed && !late) guard_pass_on(number);
    _exit(guard_status);
}

/* Names the file that is read, and keeps what its readers print off standard error: a library
   that aborts prints lines of its own.  The program's lines go on.  NULL: that is over. */
static void guard_reading(const char *path)
{
    int nowhere;
    if (path) {
        guard_file = path;
        fflush(stderr);
        guard_lines = dup(2);
        nowhere = guard_lines < 0 ? -1 : open("/dev/null", O_WRONLY);
        if (nowhere >= 0) dup2(nowhere, 2);
        if (nowhere >= 0) close(nowhere);
    } else {
        guard_file = "";
        fflush(stderr);
        if (guard_lines >= 0) dup2(guard_lines, 2);
        if (guard_lines >= 0) close(guard_lines);
    }
    if (!path || guard_lines < 0) guard_lines = 2;
}

/* A quarter of the memory that programs can still get, which Linux tells, or of all */
static double guard_quarter(void)
{
    double bytes = 0;
    unsigned long kilobytes;
    char line[100];
    FILE *file = fopen("/proc/meminfo", "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "MemAvailable: %lu", &kilobytes) == 1) bytes = 256.0 * (double)kilobytes;
    if (file) fclose(file);
#ifdef _SC_PHYS_PAGES
    if (bytes <= 0) bytes = 0.25 * (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
#endif
    return bytes;
}

/* Limits the memory to megabytes, or with 0 to a quarter of what is free, but to 1000 at least: a
   file that asks for more is refused, and does not push everything else out.  Sanitizers reserve
   far more than they use. */
static void guard_memory(int megabytes)
{
#ifndef __SANITIZE_ADDRESS__
    double bytes = megabytes ? 1e6 * megabytes : fmax(1e9, guard_quarter());
    struct rlimit limit;
    if (bytes < 1e7 || bytes > 1e15 || getrlimit(RLIMIT_AS, &limit)) return;
    if (limit.rlim_cur == RLIM_INFINITY || (double)limit.rlim_cur > bytes)
        limit.rlim_cur = (rlim_t)bytes;
    setrlimit(RLIMIT_AS, &limit);
#else
    (void)megabytes;
#endif
}

/* What guard_begin has changed, for guard_done: the signals of crashes, then those of others */
static const int guard_signals[] = { SIGSEGV, SIGBUS, SIGFPE,  SIGILL, SIGABRT, SIGALRM,
                                     SIGPROF, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU };
enum { GUARD_CRASHES = 5, GUARD_SIGNALS = sizeof guard_signals / sizeof *guard_signals };
static struct sigaction guard_before[GUARD_SIGNALS];
static struct rlimit guard_limit;

/* Watches guard_signals from first on, but not those that who started the program ignores. */
static void guard_watch(int first, int end)
{
    static char stack[65536]; /* the program's own stack may be what overflowed */
    stack_t other = { 0 };
    struct sigaction action = { 0 };
    other.ss_sp = stack;
    other.ss_size = sizeof stack;
    sigaltstack(&other, NULL);
    action.sa_handler = guard_end;
    action.sa_flags = SA_ONSTACK;
    for (int i = first; i < end; i++) {
        sigaction(guard_signals[i], &action, &guard_before[i]);
        if (i >= GUARD_CRASHES && guard_before[i].sa_handler == SIG_IGN)
            signal(guard_signals[i], SIG_IGN);
    }
}

/* Watches what ends the program from outside; a file that grows too large is an error of write. */
static inline void guard_interrupts(void)
{
    guard_watch(GUARD_CRASHES, GUARD_SIGNALS);
    signal(SIGXFSZ, SIG_IGN);
}

/* Watches the reading of a model; what else may come is the program's. */
static inline void guard_begin(int max_memory)
{
    guard_watch(0, GUARD_CRASHES);
    getrlimit(RLIMIT_AS, &guard_limit);
    guard_memory(max_memory);
}

/* Watches the whole program. */
static inline void guard_program(int max_seconds, int max_memory)
{
    struct itimerval limit = { 0 };
    guard_begin(max_memory);
    guard_interrupts();
    signal(SIGPIPE, SIG_IGN); /* write reports it instead */
    if (!max_seconds) return;
    limit.it_value.tv_sec = max_seconds;
    setitimer(ITIMER_PROF, &limit, NULL);
    if (max_seconds < 100000000)
        limit.it_value.tv_sec *= GUARD_PATIENCE; /* time_t may have 32 bits */
    setitimer(ITIMER_REAL, &limit, NULL);
}

/* Ends guard_begin: signals and memory are as they were. */
static inline void guard_done(void)
{
    setrlimit(RLIMIT_AS, &guard_limit);
    for (int i = 0; i < GUARD_CRASHES; i++) sigaction(guard_signals[i], &guard_before[i], NULL);
}

static inline int guard_terminal(void) { return isatty(2); }
#elif defined(_WIN32)
#define GUARD_WINDOWS
#include "paths.h"

/* What the watchers read: the file that is being written, in UTF-16, the program that writes it
   where it is another one, and the work in progress */
static wchar_t guard_part[4400];
static volatile HANDLE guard_child;
static const char *volatile guard_doing = "starting";
static const char *volatile guard_file = "";
static int guard_status = 1;

static inline void guard_say(const char *text)
{
    DWORD said;
    WriteFile(GetStdHandle(STD_ERROR_HANDLE), text, (DWORD)strlen(text), &said, NULL);
}

static void guard_tell(const char *what)
{
    if (guard_child && TerminateProcess(guard_child, 1)) WaitForSingleObject(guard_child, 5000);
    if (guard_part[0]) DeleteFileW(guard_part); /* save_begin shares it, so that it may be */
    guard_say(program_name);
    guard_say(what);
    guard_say(guard_doing);
    guard_say(guard_file);
    guard_say("\n");
}

static double guard_seconds(FILETIME time)
{
    return 1e-7 * (4294967296.0 * (double)time.dwHighDateTime + (double)time.dwLowDateTime);
}

/* A thread of the system calls this five times a second, with the limit.  ExitProcess would wait
   for locks that others may hold. */
static void CALLBACK guard_time(void *data, BOOLEAN fired)
{
    const double limit = *(const int *)data;
    FILETIME began, ended, system, user, now;
    (void)fired;
    GetSystemTimeAsFileTime(&now);
    if (!GetProcessTimes(GetCurrentProcess(), &began, &ended, &system, &user) ||
        (guard_seconds(system) + guard_seconds(user) < limit &&
         guard_seconds(now) - guard_seconds(began) < GUARD_PATIENCE * limit))
        return;
    guard_tell(": gave up after --max-seconds while ");
    TerminateProcess(GetCurrentProcess(), (UINT)guard_status);
}

static LONG WINAPI guard_crash(EXCEPTION_POINTERS *where)
{
    (void)where;
    guard_tell(": crashed while ");
    TerminateProcess(GetCurrentProcess(), (UINT)guard_status);
    return EXCEPTION_CONTINUE_SEARCH;
}

/* FALSE: the system ends the program as one that was interrupted. */
static BOOL WINAPI guard_interrupt(DWORD event)
{
    (void)event;
    guard_tell(": interrupted while ");
    return FALSE;
}

static void guard_reading(const char *path) { guard_file = path ? path : ""; }

/* A quarter of the memory that programs can still get */
static double guard_quarter(void)
{
    MEMORYSTATUSEX now = { .dwLength = sizeof now };
    return GlobalMemoryStatusEx(&now) ? 0.25 * (double)now.ullAvailPhys : 0;
}

/* Limits the memory to megabytes, or with 0 to a quarter of what is free, but to 1000 at least. */
static inline void guard_memory(int megabytes)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limit = { 0 };
    const double bytes = megabytes ? 1e6 * megabytes : fmax(1e9, guard_quarter());
    HANDLE job = bytes < (double)SIZE_MAX ? CreateJobObjectW(NULL, NULL) : NULL;
    if (!job) return;
    limit.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    limit.ProcessMemoryLimit = (SIZE_T)bytes;
    SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limit, sizeof limit);
    AssignProcessToJobObject(job, GetCurrentProcess());
}

static inline void guard_interrupts(void) { SetConsoleCtrlHandler(guard_interrupt, TRUE); }

/* The limit stays after guard_done: a process does not leave its job. */
static inline void guard_begin(int max_memory)
{
    ULONG stack = 65536; /* kept for guard_crash where the program's stack overflows */
    SetThreadStackGuarantee(&stack);
    SetUnhandledExceptionFilter(guard_crash);
    guard_memory(max_memory);
}
static inline void guard_done(void) { SetUnhandledExceptionFilter(NULL); }

static inline void guard_program(int max_seconds, int max_memory)
{
    static int limit;
    HANDLE timer;
    guard_begin(max_memory);
    guard_interrupts();
    limit = max_seconds;
    if (limit) CreateTimerQueueTimer(&timer, NULL, guard_time, &limit, 200, 200, WT_EXECUTEDEFAULT);
}

static inline int guard_terminal(void) { return _isatty(2); }
#else
static const char *guard_doing;
static int guard_status;
static inline void guard_program(int max_seconds, int max_memory)
{
    (void)max_seconds;
    (void)max_memory;
    (void)guard_status;
}
static inline void guard_interrupts(void) {}
static inline void guard_begin(int max_memory) { (void)max_memory; }
static inline void guard_done(void) {}
static void guard_reading(const char *path) { (void)path; }
static inline void guard_say(const char *text) { fputs(text, stderr); }
static inline int guard_terminal(void) { return 0; }
#endif
#endif
