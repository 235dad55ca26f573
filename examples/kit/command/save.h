/* save.h - writes files.  A new name appears whole or not at all: the file is written under another
   name first, which a signal that ends the program removes.  A file that exists stays the same
   file, with its mode, owner and links, as a file manager that holds it open wants it: what is to
   be in it is made first, and written over it at once.

       const int failed = save_bytes("a.ppm", writes, &data);       (a line on stderr has said why)

   Frames of a film have a writer of many files, and are replaced:

       FILE *file = save_begin("a.ppm");                       (NULL: a line on stderr has said why)
       return save_end(file, "a.ppm", fwrite(bytes, 1, n, file) < n); */
#ifndef MODEL_SAVE_H
#define MODEL_SAVE_H

#include "paths.h"
#include "guard.h"
#include "request.h"
#include <errno.h>

/* ---- names ----------------------------------------------------------------------------------- */

/* 1: the name has a dot and one of the endings, a list up to a NULL, after it. */
static inline int save_ends_in(const char *name, const char *const *endings)
{
    const char *dot = strrchr(name, '.');
    if (dot && (dot == name || dot[-1] == '/')) return 0;
    for (; dot && *endings; endings++)
        if (same_name(dot + 1, *endings)) return 1;
    return 0;
}

static inline int save_is_png(const char *name)
{
    static const char *const png[] = { "png", NULL };
    return save_ends_in(name, png);
}

static inline int save_failed(const char *name)
{
    return complain("%s: %s", name, errno ? strerror(errno) : "out of memory");
}

#ifdef GUARD_POSIX
#include <glob.h>
#include <sys/file.h>

/* 1: a device or a pipe has that name: what is written there replaces no file. */
static inline int save_is_device(const char *name)
{
    struct stat there;
    return !stat(name, &there) && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
}

/* 1: both names lead to one file. */
static inline int save_same(const char *a, const char *b)
{
    struct stat one, other;
    return !stat(a, &one) && !stat(b, &other) && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

/* ---- parts ----------------------------------------------------------------------------------- */

/* The name of this machine, without what could end a part's name early */
static inline void save_host(char *name, size_t room)
{
    if (gethostname(name, room)) *name = 0;
    name[room - 1] = 0;
    for (char *c = name; *c; c++)
        if (strchr(".*?[]/\\", *c)) *c = '-';
}

/* Removes the parts of path that killed programs have left: those of this machine whose process is
   gone.  Other machines sweep theirs. */
static inline void save_sweep(const char *path)
{
    char host[65], pattern[4400];
    glob_t found;
    if (strpbrk(path, "*?[\\")) return; /* the path itself would be a pattern */
    save_host(host, sizeof host);
    snprintf(pattern, sizeof pattern, "%s.%s.*.part", path, host);
    if (glob(pattern, 0, NULL, &found)) return;
    for (size_t i = 0; i < found.gl_pathc; i++) {
        long process = strtol(found.gl_pathv[i] + strlen(path) + strlen(host) + 2, NULL, 10);
        if (process > 0 && kill((pid_t)process, 0) && errno == ESRCH) unlink(found.gl_pathv[i]);
    }
    globfree(&found);
}

/* The name of the part that is being written, which the caller frees; NULL without memory */
static inline char *save_part(void)
{
    char *name = (char *)malloc(strlen(guard_part) + 1);
    return name ? strcpy(name, guard_part) : NULL;
}

/* Opens the file to write under another name, with the usual permissions.  Returns NULL with a line
   on stderr. */
static inline FILE *save_begin(const char *path)
{
    char host[65];
    struct stat there;
    FILE *file = NULL;
    int n, at = -1;
    save_sweep(path);
    save_host(host, sizeof host);
    n = snprintf(guard_part, sizeof guard_part, "%s.%s.%ld.part", path, host, (long)getpid());
    errno = ENAMETOOLONG;
    if (n < (int)sizeof guard_part && !stat(path, &there) && S_ISDIR(there.st_mode))
        errno = EISDIR;
    else if (n < (int)sizeof guard_part)
        at = open(guard_part, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (at >= 0) file = fdopen(at, "wb");
    if (file) return file;
    save_failed(path);
    guard_part[0] = 0;
    return NULL;
}

/* Closes the file, or with NULL takes it as another program has left it, and gives it its name, or
   removes it.  Returns 1 with a line on stderr, which the caller has printed where failed is
   SAVE_SAID. */
enum { SAVE_SAID = 2 };
static inline int save_end(FILE *file, const char *path, int failed)
{
    int error = errno;
    if (file && fclose(file) && !failed) {
        error = errno;
        failed = 1;
    }
    if (!failed && rename(guard_part, path)) {
        error = errno;
        failed = 1;
    }
    errno = error;
    if (failed && failed != SAVE_SAID) save_failed(path);
    if (failed) unlink(guard_part);
    guard_part[0] = 0;
    return failed != 0;
}

/* ---- files that exist ------------------------------------------------------------------------ */

/* The name to which links lead, there or not; path itself where they go in circles. */
static inline const char *save_target(const char *path, char *room, size_t size)
{
    const char *at = path;
    for (int links = 0; links < 16; links++) {
        char link[3000];
        const ssize_t n = readlink(at, link, sizeof link - 1);
        const char *slash = strrchr(at, '/');
        const int folder = n > 0 && link[0] != '/' && slash ? (int)(slash - at) + 1 : 0;
        char next[4096];
        if (n < 0) return at;
        link[n] = 0;
        if (snprintf(next, sizeof next, "%.*s%s", folder, at, link) >= (int)sizeof next) break;
        if (snprintf(room, size, "%s", next) >= (int)size) break;
        at = room;
    }
    return path;
}

/* 1: a file has that name, which is written over. */
static inline int save_is_there(const char *path)
{
    struct stat there;
    return !stat(path, &there) && S_ISREG(there.st_mode);
}

/* Takes the room that a file will need, before anything in it changes: a disk that is full leaves
   it as it was.  Non-zero: the reason is in errno */
static inline int save_reserve(int at, size_t size)
{
#ifdef __linux__
    const int error = size ? posix_fallocate(at, 0, (off_t)size) : 0;
    if (error != ENOSPC && error != EFBIG && error != EDQUOT) return 0;
    errno = error;
    return 1;
#else
    return (void)at, (void)size, 0;
#endif
}

/* Writes bytes over a file, one writer after the other, with no signal between.  Non-zero: the
   reason is in errno */
static inline int save_over(const char *path, const char *bytes, size_t size)
{
    const int at = open(path, O_WRONLY);
    sigset_t all, before;
    size_t done = 0;
    int failed = at < 0, error;
    if (failed) return 1;
    flock(at, LOCK_EX);
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    failed = save_reserve(at, size);
    while (done < size && !failed) {
        const ssize_t n = write(at, bytes + done, size - done);
        failed = n < 0 && errno != EINTR;
        done += n > 0 ? (size_t)n : 0;
    }
    failed = failed || ftruncate(at, (off_t)size);
    error = errno;
    failed = close(at) || failed;
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = error;
    return failed;
}
#elif defined(GUARD_WINDOWS)
static inline int save_is_device(const char *name) { return (void)name, 0; }

/* What names a file on its volume.  0: there is none. */
static inline int save_identity(const char *path, BY_HANDLE_FILE_INFORMATION *about)
{
    wchar_t *name = path_wide(path);
    const DWORD all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE file =
        name ? CreateFileW(name, 0, all, NULL, OPEN_EXISTING, 0, NULL) : INVALID_HANDLE_VALUE;
    int found = file != INVALID_HANDLE_VALUE && GetFileInformationByHandle(file, about);
    if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
    free(name);
    return found;
}

static inline int save_same(const char *a, const char *b)
{
    BY_HANDLE_FILE_INFORMATION one, other;
    return save_identity(a, &one) && save_identity(b, &other) &&
           one.dwVolumeSerialNumber == other.dwVolumeSerialNumber &&
           one.nFileIndexHigh == other.nFileIndexHigh && one.nFileIndexLow == other.nFileIndexLow;
}

static inline char *save_part(void) { return path_narrow(guard_part); }

/* The reason that the system gives, where the C library has a word for it */
static inline void save_reason(void)
{
    const DWORD error = GetLastError();
    errno = error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION ? EACCES
            : error == ERROR_PATH_NOT_FOUND || error == ERROR_FILE_NOT_FOUND ||
                    error == ERROR_INVALID_NAME
                ? ENOENT
            : error == ERROR_DISK_FULL ? ENOSPC
                                       : EIO;
}

static inline FILE *save_begin(const char *path)
{
    char part[4400];
    wchar_t *name;
    HANDLE at = INVALID_HANDLE_VALUE;
    FILE *file = NULL;
    int n = snprintf(part, sizeof part, "%s.%lu.part", path, GetCurrentProcessId());
    errno = ENAMETOOLONG;
    name = n < (int)sizeof part ? path_wide(part) : NULL;
    if (name) {
        at = CreateFileW(name, GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, NULL,
                         CREATE_ALWAYS, 0, NULL);
        if (at == INVALID_HANDLE_VALUE) save_reason();
    }
    if (at != INVALID_HANDLE_VALUE) {
        wcscpy(guard_part, name); /* UTF-16 has no more units than UTF-8 has bytes */
        n = _open_osfhandle((intptr_t)at, 0);
        file = n < 0 ? NULL : _fdopen(n, "wb");
    }
    free(name);
    if (file) return file;
    save_failed(path);
    guard_part[0] = 0;
    return NULL;
}

enum { SAVE_SAID = 2 };
static inline int save_end(FILE *file, const char *path, int failed)
{
    wchar_t *name = path_wide(path);
    if (file && fclose(file) && !failed) failed = 1;
    if (!failed && (!name || !MoveFileExW(guard_part, name, MOVEFILE_REPLACE_EXISTING))) {
        if (name) save_reason();
        failed = 1;
    }
    if (failed && failed != SAVE_SAID) save_failed(path);
    if (failed) DeleteFileW(guard_part);
    guard_part[0] = 0;
    free(name);
    return failed != 0;
}

/* 1: a file has that name, which is written over. */
static inline int save_is_there(const char *path)
{
    wchar_t *name = path_wide(path);
    const DWORD is = name ? GetFileAttributesW(name) : INVALID_FILE_ATTRIBUTES;
    free(name);
    return is != INVALID_FILE_ATTRIBUTES && !(is & FILE_ATTRIBUTE_DIRECTORY);
}

static inline int save_set_end(HANDLE file, LARGE_INTEGER size)
{
    return SetFilePointerEx(file, size, NULL, FILE_BEGIN) && SetEndOfFile(file);
}

/* Copies a file over another one, whose room is taken before anything in it changes.  0: the
   reason is that of the system */
static inline int save_copy(HANDLE from, HANDLE to)
{
    const LARGE_INTEGER start = { .QuadPart = 0 };
    LARGE_INTEGER size, was;
    char bytes[16384];
    DWORD n = 0, done = 0;
    if (!GetFileSizeEx(from, &size) || !GetFileSizeEx(to, &was)) return 0;
    if (was.QuadPart < size.QuadPart && !save_set_end(to, size)) return 0;
    if (!SetFilePointerEx(to, start, NULL, FILE_BEGIN)) return 0;
    while (ReadFile(from, bytes, sizeof bytes, &n, NULL) && n)
        if (!WriteFile(to, bytes, n, &done, NULL) || done != n) return 0;
    return save_set_end(to, size);
}

/* Writes what stands under the other name over a file, one writer after the other.  Non-zero: the
   reason is in errno */
static inline int save_over(const char *path)
{
    const DWORD all = FILE_SHARE_READ | FILE_SHARE_DELETE;
    wchar_t *name = path_wide(path);
    HANDLE from = CreateFileW(guard_part, GENERIC_READ, all, NULL, OPEN_EXISTING, 0, NULL);
    HANDLE to = INVALID_HANDLE_VALUE;
    int failed;
    for (int tries = 0; name && tries < 100 && to == INVALID_HANDLE_VALUE; tries++) {
        to = CreateFileW(name, GENERIC_WRITE, all, NULL, OPEN_EXISTING, 0, NULL);
        if (to != INVALID_HANDLE_VALUE || GetLastError() != ERROR_SHARING_VIOLATION) break;
        Sleep(20); /* another writer has it */
    }
    failed = from == INVALID_HANDLE_VALUE || to == INVALID_HANDLE_VALUE || !save_copy(from, to);
    if (failed && name) save_reason();
    if (from != INVALID_HANDLE_VALUE) CloseHandle(from);
    if (to != INVALID_HANDLE_VALUE) CloseHandle(to);
    free(name);
    return failed;
}
#else
static inline int save_is_device(const char *name) { return (void)name, 0; }
static inline int save_same(const char *a, const char *b) { return !strcmp(a, b); }

static inline FILE *save_begin(const char *path)
{
    FILE *file = path_open(path, "wb");
    if (!file) save_failed(path);
    return file;
}

enum { SAVE_SAID = 2 };
static inline int save_end(FILE *file, const char *path, int failed)
{
    if (file && fclose(file) && !failed) failed = 1;
    if (failed && failed != SAVE_SAID) save_failed(path);
    if (failed) path_remove(path);
    return failed != 0;
}
#endif

/* ---- whole files ----------------------------------------------------------------------------- */

/* Writes what data says: 0, SAVE_SAID, or 1 with the reason in errno, 0 where memory ran out. */
typedef int save_writer(FILE *file, const void *data);

#ifdef GUARD_POSIX
/* Makes in memory what is to be in a file that exists, and writes it over that. */
static inline int save_again(const char *path, save_writer *writes, const void *data)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&bytes, &size);
    int failed = memory ? writes(memory, data) : 1;
    if (memory && fclose(memory) && !failed) failed = 1;
    if (!failed) failed = save_over(path, bytes, size);
    if (failed == 1) save_failed(path);
    free(bytes);
    return failed != 0;
}
#elif defined(GUARD_WINDOWS)
/* Makes under another name what is to be in a file that exists, and writes it over that. */
static inline int save_again(const char *path, save_writer *writes, const void *data)
{
    FILE *file = save_begin(path);
    int failed = file ? writes(file, data) : SAVE_SAID;
    if (file && fclose(file) && !failed) failed = 1;
    if (!failed) failed = save_over(path);
    if (failed == 1) save_failed(path);
    if (file) DeleteFileW(guard_part);
    guard_part[0] = 0;
    return failed != 0;
}
#endif

/* Writes a file; - is standard output.  Returns 1 with a line on stderr. */
static inline int save_bytes(const char *path, save_writer *writes, const void *data)
{
    const int out = !strcmp(path, "-");
    FILE *file;
    int failed;
#ifdef GUARD_POSIX
    char room[4096];
    if (!out) path = save_target(path, room, sizeof room);
#endif
#if defined(GUARD_POSIX) || defined(GUARD_WINDOWS)
    if (!out && save_is_there(path)) return save_again(path, writes, data);
#endif
    if (!out && !save_is_device(path)) {
        file = save_begin(path);
        return file ? save_end(file, path, writes(file, data)) : 1;
    }
    file = out ? stdout : path_open(path, "wb");
    failed = file ? writes(file, data) : 1;
    if (file && (out ? fflush(file) : fclose(file)) && !failed) failed = 1;
    if (failed == 1) save_failed(out ? "standard output" : path);
    return failed != 0;
}
#endif
