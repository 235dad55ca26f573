/* listed.h - lists whose items stand where they are written: each adds itself before main runs. */
#ifndef LISTED_H
#define LISTED_H

/* Defines a function that runs before main, with gcc, clang and Microsoft's compiler: the lowest
   order, from 101, first.  Without an order programs of mingw-w64 run a file's last one first. */
#ifdef _MSC_VER
#pragma section(".CRT$XCU", read)
#define BEFORE_MAIN(name, order)                                                                   \
    static void name(void);                                                                        \
    __declspec(allocate(".CRT$XCU")) void (*const name##_entry)(void) = name;                      \
    static void name(void)
#else
#define BEFORE_MAIN(name, order) __attribute__((constructor(order))) static void name(void)
#endif

/* LISTED(type); makes type_first, the list of a struct that ends in `struct type *next`.
   LIST(type, name, fields) adds one with these fields: items stand in the order of their lines. */
#define LISTED(type) static struct type *type##_first, **type##_next = &type##_first
#define LIST(type, name, ...)                                                                      \
    BEFORE_MAIN(type##_##name##_is_listed, 101 + __LINE__)                                         \
    {                                                                                              \
        static struct type item = { __VA_ARGS__, NULL };                                           \
        *type##_next = &item;                                                                      \
        type##_next = &item.next;                                                                  \
    }

#endif
