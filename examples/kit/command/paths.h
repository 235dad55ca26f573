/* paths.h - files named in UTF-8, which Windows takes as UTF-16 alone; elsewhere names pass as they
   are.

       int main(int argc, char **argv)
       {
           path_arguments(&argc, &argv);            (names in UTF-8 with /, binary streams)
           FILE *file = path_open(argv[1], "rb"); */
#ifndef SHARED_PATHS_H
#define SHARED_PATHS_H

#include <stdio.h>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#define NOGDI /* which has a macro ERROR */
#include <windows.h>
#undef near
#undef far
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>
#include <stdlib.h>

/* The name in UTF-16, which the caller frees; NULL where it is no UTF-8. */
static inline wchar_t *path_wide(const char *path)
{
    int n = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
    wchar_t *wide = n ? (wchar_t *)malloc((size_t)n * sizeof *wide) : NULL;
    if (wide)
        MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, n);
    else
        errno = EINVAL;
    return wide;
}

static inline FILE *path_open(const char *path, const char *mode)
{
    wchar_t *name = path_wide(path), *how = path_wide(mode);
    FILE *file = name && how ? _wfopen(name, how) : NULL;
    free(name);
    free(how);
    return file;
}

static inline int path_remove(const char *path)
{
    wchar_t *name = path_wide(path);
    int failed = !name || _wremove(name);
    free(name);
    return failed;
}

static inline char *path_narrow(const wchar_t *wide)
{
    int n = WideCharToMultiByte(CP_UTF8, 0, wide, -1, NULL, 0, NULL, NULL);
    char *path = n ? (char *)malloc((size_t)n) : NULL;
    if (path) WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, n, NULL, NULL);
    return path;
}

/* Windows takes / in place of \ everywhere but behind \\?\, and the programs look for / alone. */
static inline void path_slashes(char *path)
{
    if (path[0] == '\\' && path[1] == '\\' && path[2] == '?') return;
    for (; *path; path++)
        if (*path == '\\') *path = '/';
}

/* The arguments live as long as the program.  They stay as they are where there is no memory. */
static inline void path_arguments(int *argc, char ***argv)
{
    int count = 0, narrow = 0;
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), &count);
    char **all = (char **)calloc((size_t)count + 1, sizeof *all);
    while (wide && all && narrow < count && (all[narrow] = path_narrow(wide[narrow])))
        path_slashes(all[narrow++]);
    if (wide && all && narrow == count) {
        *argc = count;
        *argv = all;
    }
    LocalFree(wide);
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
}
#else
static inline FILE *path_open(const char *path, const char *mode) { return fopen(path, mode); }
static inline int path_remove(const char *path) { return remove(path); }
static inline void path_arguments(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
}
#endif
#endif
