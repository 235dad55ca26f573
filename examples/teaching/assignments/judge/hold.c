/* hold.c - starts a program that can open no file and start no process: not in main, and not before
   it.  It keeps the files that are open: inputs, answers, what is printed.
       hold FILES PROGRAM ARGUMENTS...
   FILES is how many it may open: 0, or more where the program is not linked statically and opens
   libraries first. */
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

int main(int count, char **words)
{
    struct rlimit files = { 0, 0 };
    const struct rlimit none = { 0, 0 };
    if (count < 3) return 1;
    files.rlim_cur = files.rlim_max = (rlim_t)atoi(words[1]);
    if (setrlimit(RLIMIT_NPROC, &none) || setrlimit(RLIMIT_NOFILE, &files)) return 1;
    execv(words[2], words + 2);
    return 1;
}
