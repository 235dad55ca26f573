/* child.h - another program, which reads what we write.  POSIX or Windows.  Of several that run at
   a time, an interrupt ends the last one alone.

       child c;
       const char *const words[] = { "ffmpeg", "-i", "-", "film.mp4", NULL };
       if (child_start(&c, words)) ...                        (errno tells why not)
       fwrite(bytes, 1, size, c.input);
       return child_end(&c);                      (its exit status, CHILD_MISSING, CHILD_CRASHED) */
#ifndef BATCH_CHILD_H
#define BATCH_CHILD_H

#include "../../kit/command/guard.h"
#include <errno.h>

/* It did not end by itself, or did not read all; there is no program of that name. */
enum { CHILD_CRASHED = -1, CHILD_MISSING = 127 };

#ifdef GUARD_WINDOWS
typedef struct child {
    FILE *input;
    HANDLE process; /* NULL: there is no such program */
} child;

/* Appends a word as programs of Microsoft's C library take command lines apart: in quotation marks,
   of which each inside has a backslash before it, and so has each backslash before one. */
static inline void child_append(char *line, size_t room, const char *word)
{
    size_t n = strlen(line), slashes = 0;
    if (n + 2 * strlen(word) + 4 > room) return;
    line[n++] = '"';
    for (;; word++) {
        if (*word == '"' || !*word)
            for (; slashes; slashes--) line[n++] = '\\';
        if (!*word) break;
        if (*word == '"') line[n++] = '\\';
        slashes = *word == '\\' ? slashes + 1 : 0;
        line[n++] = *word;
    }
    line[n++] = '"';
    line[n++] = ' ';
    line[n] = 0;
}

/* Starts a program that stands on the path.  Non-zero: errno tells why it could not. */
static inline int child_start(child *c, const char *const *words)
{
    static char line[20000];
    SECURITY_ATTRIBUTES inherited = { sizeof inherited, NULL, TRUE };
    STARTUPINFOW how = { 0 };
    PROCESS_INFORMATION started = { 0 };
    HANDLE theirs, ours;
    wchar_t *wide;
    int file;
    *line = 0;
    for (; *words; words++) child_append(line, sizeof line, *words);
    wide = path_wide(line);
    if (!wide) return 1;
    if (!CreatePipe(&theirs, &ours, &inherited, 0)) {
        free(wide);
        errno = EMFILE;
        return 1;
    }
    SetHandleInformation(ours, HANDLE_FLAG_INHERIT, 0);
    how.cb = sizeof how;
    how.dwFlags = STARTF_USESTDHANDLES;
    how.hStdInput = theirs;
    how.hStdOutput = GetStdHandle(STD_OUTPUT_HANDLE);
    how.hStdError = GetStdHandle(STD_ERROR_HANDLE);
    if (CreateProcessW(NULL, wide, NULL, NULL, TRUE, 0, NULL, NULL, &how, &started))
        CloseHandle(started.hThread);
    guard_child = c->process = started.hProcess;
    CloseHandle(theirs);
    free(wide);
    file = _open_osfhandle((intptr_t)ours, 0);
    c->input = file < 0 ? NULL : _fdopen(file, "wb");
    return c->input == NULL;
}

static inline int child_end(child *c)
{
    DWORD status = CHILD_MISSING;
    const int lost = fclose(c->input);
    if (!c->process) return CHILD_MISSING;
    WaitForSingleObject(c->process, INFINITE);
    guard_child = NULL;
    GetExitCodeProcess(c->process, &status);
    CloseHandle(c->process);
    if (lost && !status) return CHILD_CRASHED;
    return status < 256 ? (int)status : CHILD_CRASHED;
}
#else
typedef struct child {
    FILE *input;
    pid_t process;
} child;

static inline int child_start(child *c, const char *const *words)
{
    int ends[2];
    signal(SIGPIPE, SIG_IGN); /* the program may end early: writing fails then */
    c->process = pipe(ends) ? -1 : fork();
    if (c->process < 0) return 1;
    if (c->process == 0) {
        close(ends[1]);
        dup2(ends[0], STDIN_FILENO);
        execvp(*words, (char **)(uintptr_t)words);
        _exit(CHILD_MISSING);
    }
    guard_child = c->process;
    close(ends[0]);
    c->input = fdopen(ends[1], "wb");
    return c->input == NULL;
}

static inline int child_end(child *c)
{
    int status = 0;
    const int lost = fclose(c->input);
    while (waitpid(c->process, &status, 0) < 0 && errno == EINTR) continue;
    guard_child = 0;
    if (lost && !status) return CHILD_CRASHED;
    return WIFEXITED(status) ? WEXITSTATUS(status) : CHILD_CRASHED;
}
#endif
#endif
