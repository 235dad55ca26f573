/* reads.c - what is only read is never written: memory in pages that allow no more than the table
   of calls.h says. */

#if PAGES
/* ------------------------------------------------------------------------ the table, row by row */

typedef struct protected_call { const call_world *w; const world_call *call; } protected_call;

static int reads_run(void *argument)
{
    const protected_call *p = (const protected_call *)argument;
    return p->call->run(p->w);
}

/* What a buffer allows while a row of the table runs. */
static int reads_access(const world_call *c, int buffer)
{
    if (world_named(c->writes, buffer)) return PROT_READ | PROT_WRITE;
    return world_named(c->reads, buffer) ? PROT_READ : PROT_NONE;
}

/* Fills a world, runs a row with the access that it names, but for one buffer (-1: none), and says
   whether it faulted. */
static int reads_faults(const call_world *w, const world_call *c, int other, int access, int *result)
{
    protected_call p = { w, c };
    int faulted;
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes, PROT_READ | PROT_WRITE);
    world_fill(w);
    c->set(w);
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes,
                   k == other ? access : reads_access(c, k));
    faulted = page_faults(reads_run, &p, result);
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes, PROT_READ | PROT_WRITE);
    return faulted;
}

static void reads_check(const call_world *w, const world_call *c)
{
    const char *touched = "what no buffer alone cures";
    int result = 0;
    if (reads_faults(w, c, -1, 0, &result)) {
        for (int k = 0; k < WORLD_BUFFERS; k++) {
            if (!reads_faults(w, c, k, PROT_READ | PROT_WRITE, &result))
                touched = world_buffers[k].name;
        }
        CHECK_SAY(0, "%s (%s) touches %s", c->name, c->when, touched);
        return;
    }
    CHECK_SAY(!result, "%s (%s) returns %d", c->name, c->when, result);
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        const int access = reads_access(c, k);
        if (access == PROT_READ)
            CHECK_SAY(reads_faults(w, c, k, PROT_NONE, &result), "%s (%s) never reads %s",
                      c->name, c->when, world_buffers[k].name);
        if (access == (PROT_READ | PROT_WRITE))
            CHECK_SAY(reads_faults(w, c, k, PROT_READ, &result), "%s (%s) never writes %s",
                      c->name, c->when, world_buffers[k].name);
    }
}
#endif

/* G19 */
TEST(reads, calls_touch_what_their_row_of_the_table_says_and_nothing_else)
{
#if PAGES
    call_world w;
    for (int k = 0; k < WORLD_BUFFERS; k++) world_put(&w, k, page_take(world_buffers[k].bytes));
    for (int i = 0; i < WORLD_CALLS; i++) reads_check(&w, &world_calls[i]);
    for (int k = 0; k < WORLD_BUFFERS; k++) page_free(world_at(&w, k), world_buffers[k].bytes);
#else
    test_skip("no mprotect");
#endif
}

static const test_case reads_cases[] = {
    CASE(reads, calls_touch_what_their_row_of_the_table_says_and_nothing_else),
};
