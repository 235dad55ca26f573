/* board.c - what a Cortex-M4F needs around the picture: start-up code, the memory functions that
   compilers call, and semihosting, through which a debugger or an emulator takes the output:
   the picture to standard output, the memory it took to standard error. */
#include "picture.h"

extern uint32_t image_data[], data_start[], data_end[], bss_start[], bss_end[], stack_top[];
int main(void);
void reset(void);
void *memcpy(void *to, const void *from, size_t size);
void *memmove(void *to, const void *from, size_t size);
void *memset(void *to, int value, size_t size);
int memcmp(const void *a, const void *b, size_t size);

/* ------------------------------------------------------------------------------- semihosting */

enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_EXIT = 0x18 };
enum { MODE_WRITE = 4, MODE_APPEND = 8 };    /* of the console ":tt": output, error output */
enum { STOPPED_NORMALLY = 0x20026, STOPPED_BY_ERROR = 0x20023 };

static uint32_t host(uint32_t operation, uint32_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uint32_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static uint32_t host_open(uint32_t mode)
{
    const uint32_t block[3] = { (uint32_t)":tt", mode, 3 };
    return host(SYS_OPEN, (uint32_t)block);
}

static void host_write(uint32_t file, const void *bytes, size_t size)
{
    const uint32_t block[3] = { file, (uint32_t)bytes, size };
    if (host(SYS_WRITE, (uint32_t)block)) host(SYS_EXIT, STOPPED_BY_ERROR);
}

static void host_number(uint32_t file, const char *name, uint32_t value)
{
    char digits[12] = "          \n";
    const char *end = name;
    int i = 10;
    while (*end) end++;
    host_write(file, name, (size_t)(end - name));
    do {
        digits[--i] = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    host_write(file, digits + i, (size_t)(11 - i));
}

/* ------------------------------------------------------------------------------------ program */

enum { PAINT = 0x5AA5C33C };
static uint32_t output;

static void send(const uint8_t *bytes, size_t size) { host_write(output, bytes, size); }

int main(void)
{
    const uint32_t *low = bss_end;
    uint32_t fixed = (uint32_t)bss_end - (uint32_t)data_start, stack, report;
    output = host_open(MODE_WRITE);
    report = host_open(MODE_APPEND);
    picture_strips(send);
    while (low < stack_top && *low == PAINT) low++;
    stack = (uint32_t)stack_top - (uint32_t)low;
    host_number(report, "static bytes ", fixed);
    host_number(report, "stack bytes ", stack);
    host_number(report, "together ", fixed + stack);
    host(SYS_EXIT, low == bss_end ? STOPPED_BY_ERROR : STOPPED_NORMALLY);
    return 0;
}

/* ----------------------------------------------------------------------------------- start-up */

static void halt(void)
{
    host(SYS_EXIT, STOPPED_BY_ERROR);
    for (;;) { }
}

void reset(void)
{
    volatile uint32_t *access = (volatile uint32_t *)0xE000ED88;    /* CPACR: who may use the FPU */
    uint32_t *p = data_start, *top;
    *access |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb\n\tmov %0, sp" : "=r"(top) : : "memory");
    for (const uint32_t *from = image_data; p < data_end;) *p++ = *from++;
    for (p = bss_start; p < bss_end;) *p++ = 0;
    while (p < top) *p++ = PAINT;    /* the stack, up to here: what changes was in use */
    main();
    halt();
}

typedef union vector { uint32_t *stack; void (*code)(void); } vector;
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    { .stack = stack_top }, { .code = reset }, { .code = halt }, { .code = halt }, { .code = halt },
    { .code = halt }, { .code = halt }
};

/* ----------------------------------------------------------------------------- for compilers */

void *memmove(void *to, const void *from, size_t size)
{
    uint8_t *t = (uint8_t *)to;
    const uint8_t *f = (const uint8_t *)from;
    if (t <= f) for (size_t i = 0; i < size; i++) t[i] = f[i];
    else while (size--) t[size] = f[size];
    return to;
}

void *memcpy(void *to, const void *from, size_t size) { return memmove(to, from, size); }
void *memset(void *to, int value, size_t size)
{
    uint8_t *t = (uint8_t *)to;
    while (size--) *t++ = (uint8_t)value;
    return to;
}
int memcmp(const void *a, const void *b, size_t size)
{
    const uint8_t *x = (const uint8_t *)a, *y = (const uint8_t *)b;
    for (; size; size--, x++, y++)
        if (*x != *y) return *x - *y;
    return 0;
}
