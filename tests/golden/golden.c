/* golden.c - holds picture files to recorded hashes.

     golden file ...                compares each file, prints N passed, N failed
     golden --as VERSION file ...   compares with the hashes of that version
     golden --update file ...       writes this version's hashes anew, if all its pictures are given

   tests/golden/pictures.txt has a line for each picture: its name without folder, and its 64-bit
   FNV-1a hash in each version of its first line; - where the version has none.  Files are compared
   with the newest version that is not beyond SHADE_VERSION; those before it stay, for
   tests/scripts/abi.sh. */
#include "shade.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURES = 200, VERSIONS = 9, NAME = 80 };
static const char list[] = "tests/golden/pictures.txt";

/* Rows of the list; the first has the versions. */
static struct { char name[NAME], hash[VERSIONS][NAME]; } row[PICTURES];
static int rows, versions;

static int read_list(void)
{
    FILE *f = fopen(list, "r");
    char line[VERSIONS * NAME];
    while (f && rows < PICTURES && fgets(line, sizeof line, f)) {
        int columns = 0, at = 0, used;
        if (sscanf(line, "%79s%n", row[rows].name, &at) != 1) continue;
        while (columns < VERSIONS &&
               sscanf(line + at, "%79s%n", row[rows].hash[columns], &used) == 1) {
            at += used;
            columns++;
        }
        if (!rows++) versions = columns;
    }
    return f && !fclose(f) && versions > 0;
}

static int number_of(const char *version)
{
    int major = 0, minor = 0;
    return sscanf(version, "%d.%d", &major, &minor) == 2 ? 100 * major + minor : 0;
}

/* The column of the newest version up to this one; -1: there is none */
static int column_of(int number)
{
    int column = -1;
    for (int k = 0; k < versions; k++) {
        if (number_of(row[0].hash[k]) <= number) column = k;
    }
    return column;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The row of a picture; 0, that of the versions: it has none */
static int row_of(const char *name)
{
    for (int i = 1; i < rows; i++) {
        if (!strcmp(row[i].name, name)) return i;
    }
    return 0;
}

/* 0 where the file cannot be read; else 1 and its hash, in digits */
static int hash_file(const char *path, char digits[NAME])
{
    FILE *f = fopen(path, "rb");
    unsigned char block[65536];
    uint64_t hash = 14695981039346656037u;
    size_t size;
    int ok = 0;
    if (f) {
        while ((size = fread(block, 1, sizeof block, f)) > 0) {
            for (size_t i = 0; i < size; i++) hash = (hash ^ block[i]) * 1099511628211u;
        }
        ok = !ferror(f);
        fclose(f);
    }
    if (!ok) printf("%s: cannot be read\n", path);
    snprintf(digits, NAME, "%016llx", (unsigned long long)hash);
    return ok;
}

static int by_name(const void *a, const void *b)
{
    return strcmp((const char *)a, (const char *)b);    /* names come first */
}

static int write_list(void)
{
    FILE *f = fopen(list, "w");
    int width = 0;
    for (int i = 0; i < rows; i++) {
        int length = (int)strlen(row[i].name);
        if (length > width) width = length;
    }
    qsort(row + 1, (size_t)(rows - 1), sizeof row[0], by_name);
    for (int i = 0; f && i < rows; i++) {
        fprintf(f, "%-*s", width, row[i].name);
        for (int k = 0; k < versions; k++)
            fprintf(f, k + 1 < versions ? " %-16s" : " %s\n", row[i].hash[k]);
    }
    return f && !fclose(f);
}

static int update(int count, char **paths)
{
    const int now = SHADE_VERSION / 100;
    int column = column_of(now), all = 1;
    if (column < 0 || number_of(row[0].hash[column]) != now) {
        if (versions == VERSIONS) return 1;
        column = versions++;
        for (int i = 1; i < rows; i++) strcpy(row[i].hash[column], "-");
        snprintf(row[0].hash[column], NAME, "%d.%d", now / 100, now % 100);
    }
    for (int i = 1; i < rows; i++) {
        int found = !strcmp(row[i].hash[column], "-");
        for (int k = 0; k < count && !found; k++) found = !strcmp(name_of(paths[k]), row[i].name);
        if (!found) printf("%s: name it too, or write - into %s\n", row[i].name, list);
        all = all && found;
    }
    for (int k = 0; k < count; k++) {
        int i = row_of(name_of(paths[k]));
        if (!i && rows < PICTURES) {
            i = rows++;
            snprintf(row[i].name, NAME, "%s", name_of(paths[k]));
            for (int v = 0; v < versions; v++) strcpy(row[i].hash[v], "-");
        }
        all = i && hash_file(paths[k], row[i].hash[column]) && all;
    }
    all = all && write_list();
    printf(all ? "%d hashes written to %s\n" : "%d hashes could not be written to %s\n", count,
           list);
    return !all;
}

int main(int argc, char **argv)
{
    int passed = 0, failed = 0, first = 1, number = SHADE_VERSION / 100, column;
    const int listed = read_list();
    if (listed && argc > 1 && !strcmp(argv[1], "--update")) return update(argc - 2, argv + 2);
    if (argc > 2 && !strcmp(argv[1], "--as")) {
        number = number_of(argv[2]);
        first = 3;
    }
    column = column_of(number);
    for (int i = first; i < argc; i++) {
        char got[NAME];
        const char *want = column < 0 ? "-" : row[row_of(name_of(argv[i]))].hash[column];
        if (!hash_file(argv[i], got)) {
            failed++;
        } else if (strcmp(got, want) != 0) {
            printf("%s: got %s, %s has %s\n", argv[i], got, list, want);
            failed++;
        } else {
            passed++;
        }
    }
    if (first >= argc) {
        printf("golden: no picture given\n");
        failed = 1;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
