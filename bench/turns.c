/* turns.c - runs commands in turns and prints, of each, the fewest seconds of processor time that
   it took with all that it started, user and system, whatever else the machine does; behind a colon
   the most memory of one of its processes, in MB.

   cc -O2 bench/turns.c -o turns && ./turns 5 ls / -- ls -l / */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for wait4 with -std=c99 */
#include "clock.h"
#include <sys/resource.h>
#include <sys/wait.h>

enum { MOST_COMMANDS = 8 };

static double seconds(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

/* Runs a command; *most becomes the memory of its largest run. */
static double run(char **command, double *most)
{
    struct rusage r;
    int status = 1;
    const pid_t child = fork();
    if (!child) {
        if (freopen("/dev/null", "w", stdout)) execvp(command[0], command);
        _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &r) != child || status) {
        fprintf(stderr, "turns: %s failed\n", command[0]);
        exit(1);
    }
    if ((double)r.ru_maxrss / 1e3 > *most) *most = (double)r.ru_maxrss / 1e3;
    return seconds(r.ru_utime) + seconds(r.ru_stime);
}

int main(int argc, char **argv)
{
    const int rounds = argc > 1 ? atoi(argv[1]) : 0;
    char **command[MOST_COMMANDS];
    double least[MOST_COMMANDS], most[MOST_COMMANDS] = { 0 };
    int count = 0;
    for (int i = 2, begins = 1; i < argc && count < MOST_COMMANDS; i++) {
        if (begins) command[count++] = argv + i;
        begins = !strcmp(argv[i], "--");
        if (begins) argv[i] = NULL;
    }
    for (int round = 0; round < rounds; round++)
        for (int k = 0; k < count; k++) {
            const double taken = run(command[k], &most[k]);
            if (!round || taken < least[k]) least[k] = taken;
        }
    for (int k = 0; k < count && rounds > 0; k++)
        printf("%.3f:%.0f%c", least[k], most[k], " \n"[k + 1 == count]);
    return rounds < 1 || !count;
}
