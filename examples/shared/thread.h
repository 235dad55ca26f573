/* thread.h - threads, a lock and the number of cores, of POSIX or of Windows.  Without either, or
   with BANDS_ALONE, THREAD_NONE is defined and nothing else. */
#ifndef SHARED_THREAD_H
#define SHARED_THREAD_H

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
#endif
