/* turns.c - runs commands in turns and prints, of each, the fewest seconds of processor time that
   it took with all that it started: user and system, whatever else the machine does.

   cc -O2 bench/turns.c -o turns && ./turns 5 ls / -- ls -l / */
#include "clock.h"
#include <sys/resource.h>
#include <sys/wait.h>

enum { MOST_COMMANDS = 8 };

static double seconds(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

/* Of the children that have ended */
static double taken(void)
{
    struct rusage r;
    getrusage(RUSAGE_CHILDREN, &r);
    return seconds(r.ru_utime) + seconds(r.ru_stime);
}

static void run(char **command)
{
    int status = 1;
    const pid_t child = fork();
    if (!child) {
        if (freopen("/dev/null", "w", stdout)) execvp(command[0], command);
        _exit(127);
    }
    if (child > 0 && waitpid(child, &status, 0) == child && !status) return;
    fprintf(stderr, "turns: %s failed\n", command[0]);
    exit(1);
}

int main(int argc, char **argv)
{
    const int rounds = argc > 1 ? atoi(argv[1]) : 0;
    char **command[MOST_COMMANDS];
    double least[MOST_COMMANDS];
    int count = 0;
    for (int i = 2, begins = 1; i < argc && count < MOST_COMMANDS; i++) {
        if (begins) command[count++] = argv + i;
        begins = !strcmp(argv[i], "--");
        if (begins) argv[i] = NULL;
    }
    for (int round = 0; round < rounds; round++)
        for (int k = 0; k < count; k++) {
            const double start = taken();
            run(command[k]);
            if (!round || taken() - start < least[k]) least[k] = taken() - start;
        }
    for (int k = 0; k < count && rounds > 0; k++) printf("%.3f%c", least[k], " \n"[k + 1 == count]);
    return rounds < 1 || !count;
}
