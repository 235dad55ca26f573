/* golden.c - holds picture files to recorded hashes.

     golden file ...              compares each file, prints N passed, N failed
     golden --list LIST file ...  compares with the hashes of that file
     golden --update file ...     writes this version's file anew, if all its pictures are given

   tests/golden/1.1.txt has the hashes of version 1.1, and so on: one line per picture, its name
   without folder and its 64-bit FNV-1a hash.  Files are compared with the newest one that is not
   beyond SHADE_VERSION; that of 1.1 stays, for tests/scripts/abi.sh. */
#include "shade.h"
#include <stdio.h>
#include <string.h>

static char list[300];    /* tests/golden/major.minor.txt */

static void name_list(int minor)
{
    snprintf(list, sizeof list, "tests/golden/%d.%d.txt", SHADE_VERSION / 10000, minor);
}

/* The list of the newest version that has one. */
static void find_list(void)
{
    for (int minor = SHADE_VERSION / 100 % 100; minor >= 0; minor--) {
        name_list(minor);
        FILE *f = fopen(list, "r");
        if (!f) continue;
        fclose(f);
        return;
    }
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* 0 where the file cannot be read; else 1 and its hash */
static int hash_file(const char *path, uint64_t *hash)
{
    FILE *f = fopen(path, "rb");
    unsigned char block[65536];
    size_t size;
    *hash = 14695981039346656037u;
    if (!f) return 0;
    while ((size = fread(block, 1, sizeof block, f)) > 0) {
        for (size_t i = 0; i < size; i++) *hash = (*hash ^ block[i]) * 1099511628211u;
    }
    int ok = !ferror(f);
    fclose(f);
    return ok;
}

static int recorded_hash(const char *name, uint64_t *hash)
{
    FILE *f = fopen(list, "r");
    char line[400], recorded[300];
    unsigned long long value;
    int found = 0;
    if (!f) return 0;
    while (!found && fgets(line, sizeof line, f)) {
        found = sscanf(line, "%299s %llx", recorded, &value) == 2 && !strcmp(recorded, name);
    }
    fclose(f);
    if (found) *hash = value;
    return found;
}

/* Do all pictures of the list stand among the paths? */
static int names_all(int count, char **paths)
{
    FILE *f = fopen(list, "r");
    char line[400], recorded[300];
    int all = 1;
    while (f && fgets(line, sizeof line, f)) {
        int found = 0;
        if (sscanf(line, "%299s", recorded) != 1) continue;
        for (int i = 0; i < count && !found; i++) found = !strcmp(name_of(paths[i]), recorded);
        if (!found) printf("%s: name it too, or remove its line of %s\n", recorded, list);
        all = all && found;
    }
    if (f) fclose(f);
    return all;
}

static int update(int count, char **paths)
{
    name_list(SHADE_VERSION / 100 % 100);
    if (!names_all(count, paths)) return 1;
    FILE *f = fopen(list, "w");
    int ok = f != NULL;
    for (int i = 0; i < count && ok; i++) {
        uint64_t hash;
        ok = hash_file(paths[i], &hash);
        if (!ok)
            printf("%s: cannot be read\n", paths[i]);
        else
            fprintf(f, "%s %016llx\n", name_of(paths[i]), (unsigned long long)hash);
    }
    if (f && fclose(f)) ok = 0;
    printf(ok ? "%d hashes written to %s\n" : "%d hashes could not be written to %s\n", count,
           list);
    return !ok;
}

int main(int argc, char **argv)
{
    int passed = 0, failed = 0, first = 1;
    if (argc > 1 && !strcmp(argv[1], "--update")) return update(argc - 2, argv + 2);
    if (argc > 2 && !strcmp(argv[1], "--list")) {
        snprintf(list, sizeof list, "%s", argv[2]);
        first = 3;
    } else {
        find_list();
    }
    for (int i = first; i < argc; i++) {
        uint64_t got = 0, want = 0;
        if (!hash_file(argv[i], &got))
            printf("%s: cannot be read\n", argv[i]);
        else if (!recorded_hash(name_of(argv[i]), &want))
            printf("%s: not in %s\n", argv[i], list);
        else if (got != want) {
            printf("%s: got %016llx, want %016llx\n", argv[i], (unsigned long long)got,
                   (unsigned long long)want);
        } else {
            passed++;
            continue;
        }
        failed++;
    }
    if (first >= argc) {
        printf("golden: no picture given\n");
        failed = 1;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
