/* bands.h - spreads work over threads.  It is cut into pieces, often the bands of a picture, which
   the threads take from one counter: a thread that is done takes the next piece, so that none waits
   for a slow one.

       static void draw_band(void *data, int band) { ... }      (sets clip_y and clip_height)
       bands_run(0, 64, draw_band, &job);                       (on all cores; returns when done)

   The result of a piece may depend on its number, but not on the thread or the time.  Threads are
   those of POSIX or of Windows.  Where there are none, or with BANDS_ALONE, THREAD_NONE is defined
   and the pieces are done one after the other. */
#ifndef SHARED_BANDS_H
#define SHARED_BANDS_H

#include "shade.h"
#include <stddef.h>

/* ---- threads, a lock and the number of cores ------------------------------------------------- */

#ifdef BANDS_ALONE
#define THREAD_NONE
#elif defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#define NOGDI    /* which has a macro ERROR */
#include <windows.h>
#undef near
#undef far

typedef CRITICAL_SECTION thread_lock;
typedef struct thread {
    void (*run)(void *data);
    void *data;
    HANDLE handle;
} thread;

static inline void thread_lock_open(thread_lock *lock) { InitializeCriticalSection(lock); }
static inline void thread_lock_close(thread_lock *lock) { DeleteCriticalSection(lock); }
static inline void thread_lock_take(thread_lock *lock) { EnterCriticalSection(lock); }
static inline void thread_lock_give(thread_lock *lock) { LeaveCriticalSection(lock); }

static inline DWORD WINAPI thread_main(void *data)
{
    thread *t = (thread *)data;
    t->run(t->data);
    return 0;
}

/* Non-zero: it runs, until thread_join; *t stays where it is so long. */
static inline int thread_start(thread *t, void (*run)(void *data), void *data)
{
    t->run = run;
    t->data = data;
    t->handle = CreateThread(NULL, 0, thread_main, t, 0, NULL);
    return t->handle != NULL;
}

static inline void thread_join(thread *t)
{
    WaitForSingleObject(t->handle, INFINITE);
    CloseHandle(t->handle);
}

static inline long thread_cores(void)
{
    SYSTEM_INFO info;
    GetSystemInfo(&info);
    return (long)info.dwNumberOfProcessors;
}
#elif defined(__unix__) || defined(__APPLE__)
#include <pthread.h>
#include <unistd.h>

typedef pthread_mutex_t thread_lock;
typedef struct thread {
    void (*run)(void *data);
    void *data;
    pthread_t handle;
} thread;

static inline void thread_lock_open(thread_lock *lock) { pthread_mutex_init(lock, NULL); }
static inline void thread_lock_close(thread_lock *lock) { pthread_mutex_destroy(lock); }
static inline void thread_lock_take(thread_lock *lock) { pthread_mutex_lock(lock); }
static inline void thread_lock_give(thread_lock *lock) { pthread_mutex_unlock(lock); }

static inline void *thread_main(void *data)
{
    thread *t = (thread *)data;
    t->run(t->data);
    return NULL;
}

/* Non-zero: it runs, until thread_join; *t stays where it is so long. */
static inline int thread_start(thread *t, void (*run)(void *data), void *data)
{
    t->run = run;
    t->data = data;
    return !pthread_create(&t->handle, NULL, thread_main, t);
}

static inline void thread_join(thread *t) { pthread_join(t->handle, NULL); }
static inline long thread_cores(void) { return sysconf(_SC_NPROCESSORS_ONLN); }
#else
#define THREAD_NONE
#endif

/* ---- bands ----------------------------------------------------------------------------------- */

enum { BANDS_MOST = 256 };    /* threads, at most */
typedef void bands_work(void *data, int piece);
typedef void bands_progress(void *user, double part);

#ifndef THREAD_NONE
typedef struct bands {
    bands_work *work;
    void *data;
    int next, count;
    thread_lock lock; /* of next */
} bands;

/* Returns the number of the next piece, or -1 where all are taken. */
static inline int bands_take(bands *b)
{
    int piece;
    thread_lock_take(&b->lock);
    piece = b->next < b->count ? b->next++ : -1;
    thread_lock_give(&b->lock);
    return piece;
}

static inline void bands_thread(void *data)
{
    bands *b = (bands *)data;
    for (int piece; (piece = bands_take(b)) >= 0;) b->work(b->data, piece);
}

static inline int bands_cores(void)
{
    long cores = thread_cores();
    return cores < 1 ? 1 : cores < BANDS_MOST ? (int)cores : BANDS_MOST;
}

/* Does the pieces 0 .. count - 1 by so many threads (0: as many as there are cores), of which the
   caller is one and tells its progress; fewer where the system gives no more. */
static inline void bands_run_told(int threads, int count, bands_work *work, void *data,
                                  bands_progress *progress, void *user)
{
    bands b;
    thread helper[BANDS_MOST];
    int others = 0;
    b.work = work;
    b.data = data;
    b.next = 0;
    b.count = count;
    thread_lock_open(&b.lock);
    if (threads < 1) threads = bands_cores();
    if (threads > count) threads = count;
    while (others < threads - 1 && others < BANDS_MOST &&
           thread_start(&helper[others], bands_thread, &b))
        others++;
    for (int piece; (piece = bands_take(&b)) >= 0;) {
        if (progress) progress(user, (double)piece / count);
        work(data, piece);
    }
    while (others > 0) thread_join(&helper[--others]);
    thread_lock_close(&b.lock);
}
#else
static inline int bands_cores(void) { return 1; }

static inline void bands_run_told(int threads, int count, bands_work *work, void *data,
                                  bands_progress *progress, void *user)
{
    (void)threads;
    for (int piece = 0; piece < count; piece++) {
        if (progress) progress(user, (double)piece / count);
        work(data, piece);
    }
}
#endif

static inline void bands_run(int threads, int count, bands_work *work, void *data)
{
    bands_run_told(threads, count, work, data, NULL, NULL);
}

/* A good number of bands: eight for each thread, of at least 16 rows each; one for one thread */
static inline int bands_count(int threads, int rows)
{
    if (threads < 1) threads = bands_cores();
    if (threads == 1 || rows < 32) return 1;
    return 8 * threads < rows / 16 ? 8 * threads : rows / 16;
}

/* The rows of a band, one of count, of a target without a clip rectangle; of a strip its rows.  A
   band without rows draws nothing. */
static inline shade_target bands_rows(const shade_target *target, int band, int count)
{
    shade_target part = *target;
    const long long rows = part.row_count ? part.row_count : part.height;
    const int end = (int)(rows * (band + 1) / count);
    part.clip_y = (int)(rows * band / count);
    part.clip_height = end - part.clip_y;
    part.clip_y += part.row_offset;
    part.clip_width = part.width;
    return part;
}
#endif
