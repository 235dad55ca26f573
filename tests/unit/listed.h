/* listed.h - lists whose items stand where they are written: each adds itself before main runs. */
#ifndef LISTED_H
#define LISTED_H

/* Defines a function that runs before main, with gcc, clang and Microsoft's compiler. */
#ifdef _MSC_VER
#pragma section(".CRT$XCU", read)
#define BEFORE_MAIN(name)                                                                          \
    static void name(void);                                                                        \
    __declspec(allocate(".CRT$XCU")) void (*const name##_entry)(void) = name;                      \
    static void name(void)
#else
#define BEFORE_MAIN(name) __attribute__((constructor)) static void name(void)
#endif

/* LISTED(type); makes type_first, the list of a struct that ends in `struct type *next`.
   LIST(type, name, fields) adds one with these fields to its end. */
#define LISTED(type) static struct type *type##_first, **type##_next = &type##_first
#define LIST(type, name, ...)                                                                      \
    BEFORE_MAIN(type##_##name##_is_listed)                                                         \
    {                                                                                              \
        static struct type item = { __VA_ARGS__, NULL };                                           \
        *type##_next = &item;                                                                      \
        type##_next = &item.next;                                                                  \
    }

#endif
