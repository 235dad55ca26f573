/* lanes.c - light on packets, against double precision. */
#include "unit.h"

/* Holds each lane of a packet to the equation.  Returns how many were away from discontinuities. */
static int check_packet(light_sample *s, const lane_packet *k, int with_albedo)
{
    float rgb[3 * SHADE_LANES];
    int sure = 0;
    lit_rows(&s->lighting, &s->material, s->eye, k->P[0], k->N[0],
             with_albedo ? k->albedo[0] : NULL, NULL, rgb);
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec3 got = shade_v3(rgb[i], rgb[SHADE_LANES + i], rgb[2 * SHADE_LANES + i]);
        d3 albedo = with_albedo ? d3_from(k->a[i]) : d3_of(1, 1, 1);
        ref_lit want = ref_light(&s->lighting, &s->material, d3_from(k->p[i]), d3_from(k->n[i]),
                                 d3_from(s->eye), albedo);
        CHECK(finite3(got));
        if (want.unsure) continue;
        sure++;
        if (check_color(__LINE__, "packet", got, want.total, want.bound)) continue;
        s->P = k->p[i];
        s->N = k->n[i];
        print_lights(s);
    }
    return sure;
}

/* G18 */
TEST(lanes, a_packet_matches_the_equation_for_every_flag_and_model)
{
    static lane_packet k;
    light_sample s;
    int sure = 0, total = 0;
    for (int round = 0; round < 1600; round++) {
        random_sample(&s);
        random_packet(&k, &s, d3_length(d3_from(s.P)) * 1e-2 + 1);
        sure += check_packet(&s, &k, rnd_one_in(2));
        total += SHADE_LANES;
    }
    CHECK_SAY(sure > total / 2, "%d of %d lanes are away from discontinuities", sure, total);
}

/* G14 */
TEST(lanes, every_lane_is_computed_the_same) /* no lane depends on its neighbours or its place */
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 400; round++) {
        random_sample(&s);
        random_packet(&k, &s, 2);
        float one[3 * SHADE_LANES], other[3 * SHADE_LANES];
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], k.albedo[0], NULL, one);
        int turn = rnd_int(1, SHADE_LANES - 1);
        for (int i = 0; i < SHADE_LANES; i++) {
            int j = (i + turn) % SHADE_LANES;
            lane_set(k.P, j, k.p[i]);
            lane_set(k.N, j, k.n[i]);
            lane_set(k.albedo, j, k.a[i]);
        }
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], k.albedo[0], NULL, other);
        for (int i = 0; i < 3 * SHADE_LANES; i++) {
            int row = i / SHADE_LANES * SHADE_LANES, j = row + (i - row + turn) % SHADE_LANES;
            CHECK_SAY(float_bits(one[i]) == float_bits(other[j]), "lane %d: %a, moved to %d: %a", i,
                      (double)one[i], j, (double)other[j]);
        }
    }
}

/* Exponents around 100, the viewer near the mirror direction: the bound then allows a cosine an
   error of 5e-7 and no more.  Packets and scalars. */
/* G18 */
TEST(lanes, highlights_hold_the_bound_where_it_is_tightest)
{
    static lane_packet k;
    double worst[2] = { 0, 0 };
    light_sample s = { .material.specular = shade_v3(1, 1, 1) };
    s.lighting.lights = s.lights;
    s.lighting.light_count = 1;
    s.lighting.terms = SHADE_TERM_SPECULAR;
    for (int round = 0; round < 2500; round++) {
        d3 at = d3_scale(rnd_direction(), (double)rnd_log(1, 100));
        s.lights[0] = rnd_one_in(2) ? shade_directional_light(d3_round(at), grey(1))
                                    : shade_point_light(d3_round(at), grey(1));
        s.material.shininess = rnd_float(80, 130);
        s.lighting.model = round % 2 ? SHADE_MODEL_PHONG : SHADE_MODEL_BLINN_PHONG;
        double r;
        d3 N = rnd_direction(), L = ref_to_light(&s.lights[0], d3_of(0, 0, 0), &r);
        if (d3_dot(N, L) < 0) N = d3_scale(N, -1);
        d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L);
        d3 V = d3_unit(d3_add(R, d3_scale(rnd_direction(), 0.15)));
        s.eye = d3_round(d3_scale(V, (double)rnd_log(0.5, 100)));
        for (int i = 0; i < SHADE_LANES; i++) {
            d3 turned = d3_unit(d3_add(N, d3_scale(rnd_direction(), 0.05)));
            k.n[i] = d3_round(d3_scale(turned, (double)rnd_log(0.1, 10)));
            k.p[i] = d3_round(d3_scale(rnd_direction(), 0.01));
            lane_set(k.P, i, k.p[i]);
            lane_set(k.N, i, k.n[i]);
        }
        float rgb[3 * SHADE_LANES];
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb);
        for (int i = 0; i < SHADE_LANES; i++) {
            ref_lit want = ref_light(&s.lighting, &s.material, d3_from(k.p[i]), d3_from(k.n[i]),
                                     d3_from(s.eye), d3_of(1, 1, 1));
            shade_vec3 one = shade_lit(&s.lighting, &s.material, s.eye, k.p[i], k.n[i]);
            if (want.unsure) continue;
            worst[0] = fmax(worst[0], fabs((double)rgb[i] - want.total.x) / want.bound);
            worst[1] = fmax(worst[1], fabs((double)one.x - want.total.x) / want.bound);
        }
    }
    CHECK_SAY(worst[0] < 1, "packets: %g of the bound", worst[0]);
    CHECK_SAY(worst[1] < 1, "scalars: %g of the bound", worst[1]);
}

/* A lamp and an eye on nearly opposite sides of the packet's points, within an angle of `narrow`,
   and normals around H.  facing: all lanes face the lamp. */
static void random_opposite_packet(light_sample *s, lane_packet *k, int facing)
{
    d3 away = rnd_direction();
    double narrow = (double)rnd_log(3e-4, 0.05);
    s->lights[0] = shade_point_light(d3_round(d3_scale(away, (double)rnd_log(1, 30))), grey(1));
    d3 beside = d3_scale(rnd_direction(), narrow);
    s->eye = d3_round(d3_scale(d3_unit(d3_sub(beside, away)), (double)rnd_log(1, 30)));
    s->material.shininess = rnd_float(1, 120);
    for (int i = 0; i < SHADE_LANES; i++) {
        k->p[i] = d3_round(d3_scale(rnd_direction(), narrow * rnd_unit()));
        double r;
        d3 P = d3_from(k->p[i]), L = ref_to_light(&s->lights[0], P, &r);
        d3 H = d3_unit(d3_add(L, d3_unit(d3_sub(d3_from(s->eye), P))));
        do {
            d3 turned = d3_add(H, d3_scale(rnd_direction(), 0.3 * rnd_unit()));
            k->n[i] = d3_round(d3_unit(turned));
        } while (facing && d3_dot(d3_from(k->n[i]), L) <= 0);
        lane_set(k->P, i, k->p[i]);
        lane_set(k->N, i, k->n[i]);
    }
}

/* Lamp and viewer at the two horizons: L + V is short, its direction is left to the last digits of
   L and V, and N may lie along it. */
/* G18 */
TEST(lanes, highlights_hold_the_bound_where_lamp_and_viewer_are_nearly_opposite)
{
    static lane_packet k;
    double worst[2] = { 0, 0 };
    long checked = 0;
    light_sample s = { .material.specular = shade_v3(1, 1, 1) };
    s.lighting.lights = s.lights;
    s.lighting.light_count = 1;
    s.lighting.terms = SHADE_TERM_SPECULAR;
    for (int round = 0; round < 400; round++) {
        static const unsigned flags[] = { 0, SHADE_FLAG_UNGATED_SPECULAR, SHADE_FLAG_TWO_SIDED };
        random_opposite_packet(&s, &k, round % 2);
        s.lighting.flags = flags[round % 3];
        float rgb[3 * SHADE_LANES];
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb);
        for (int i = 0; i < SHADE_LANES; i++) {
            double r;
            d3 P = d3_from(k.p[i]), L = ref_to_light(&s.lights[0], P, &r);
            d3 V = d3_unit(d3_sub(d3_from(s.eye), P));
            ref_lit want = ref_light(&s.lighting, &s.material, P, d3_from(k.n[i]), d3_from(s.eye),
                                     d3_of(1, 1, 1));
            shade_vec3 one = shade_lit(&s.lighting, &s.material, s.eye, k.p[i], k.n[i]);
            if (want.unsure || d3_length(d3_add(L, V)) < 1e-4) continue; /* exempt */
            worst[0] = fmax(worst[0], fabs((double)rgb[i] - want.total.x) / want.bound);
            worst[1] = fmax(worst[1], fabs((double)one.x - want.total.x) / want.bound);
            checked += want.total.x > 0.01;
        }
    }
    CHECK_SAY(worst[0] < 1, "packets: %g of the bound", worst[0]);
    CHECK_SAY(worst[1] < 1, "scalars: %g of the bound", worst[1]);
    CHECK_SAY(checked > 50L * SHADE_LANES, "%ld highlights", checked);
}

/* V or L is zero: no direction, so no highlight but that of exponent 0 where there is a mirror */
TEST(lanes, an_eye_or_a_lamp_at_the_point_itself_is_the_equation_too)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 300; round++) {
        random_sample(&s);
        random_packet(&k, &s, 1);
        s.lighting.model = round % 2 ? SHADE_MODEL_PHONG : SHADE_MODEL_BLINN_PHONG;
        s.lighting.flags &= ~(unsigned)(SHADE_FLAG_TWO_SIDED | SHADE_FLAG_INFINITE_VIEWER);
        s.lighting.light_count = 1;
        if (s.lights[0].position.w != 0) s.lights[0].position.w = 1;
        for (int i = 0; i < SHADE_LANES; i++) {
            shade_vec4 at = s.lights[0].position;
            k.p[i] = i % 2 && at.w == 1 ? shade_v3(at.x, at.y, at.z) : s.eye;
            lane_set(k.P, i, k.p[i]);
        }
        check_packet(&s, &k, 0);
    }
}

/* What belongs to a term that is off may hold anything: NaN there changes no bit of the rest. */
TEST(lanes, a_term_that_is_off_reads_nothing)
{
    static lane_packet k;
    light_sample s;
    shade_vec3 bad = shade_v3((float)NAN, (float)NAN, (float)NAN);
    for (int round = 0; round < 320; round++) {
        random_sample(&s);
        random_packet(&k, &s, 1);
        s.lighting.terms = (unsigned)(round % 15 + 1);
        s.lighting.model = SHADE_MODEL_BLINN_PHONG;
        shade_lighting li = s.lighting;
        shade_material m = s.material;
        shade_light lights[sizeof s.lights / sizeof s.lights[0]];
        memcpy(lights, s.lights, sizeof s.lights);
        li.lights = lights;
        if (!(li.terms & SHADE_TERM_EMISSION)) m.emission = bad;
        if (!(li.terms & SHADE_TERM_AMBIENT)) m.ambient = li.ambient = bad;
        if (!(li.terms & SHADE_TERM_DIFFUSE)) m.diffuse = bad;
        if (!(li.terms & SHADE_TERM_SPECULAR)) m.specular = bad;
        for (int j = 0; j < li.light_count; j++) {
            if (!(li.terms & SHADE_TERM_AMBIENT)) lights[j].ambient = bad;
            if (!(li.terms & SHADE_TERM_DIFFUSE)) lights[j].diffuse = bad;
            if (!(li.terms & SHADE_TERM_SPECULAR)) lights[j].specular = bad;
        }
        float got[3 * SHADE_LANES], want[3 * SHADE_LANES];
        lit_rows(&li, &m, s.eye, k.P[0], k.N[0], NULL, NULL, got);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, want);
        for (int i = 0; i < 3 * SHADE_LANES; i++) CHECK_NEAR(got[i], want[i], 0);
        shade_vec3 a = shade_lit(&li, &m, s.eye, s.P, s.N);
        shade_vec3 b = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        CHECK(a.x == b.x && a.y == b.y && a.z == b.z);
    }
}

/* An albedo of 1 changes nothing, and none changes emission or highlights. */
TEST(lanes, albedo_multiplies_diffuse_and_ambient_only)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 200; round++) {
        random_sample(&s);
        random_packet(&k, &s, 2);
        float bare[3 * SHADE_LANES], with[3 * SHADE_LANES], ones[3 * SHADE_LANES];
        for (int i = 0; i < 3 * SHADE_LANES; i++) ones[i] = 1;
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, bare);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], ones, NULL, with);
        for (int i = 0; i < 3 * SHADE_LANES; i++)
            CHECK_NEAR(with[i], bare[i], 1e-6 * fabs((double)bare[i]));
        s.lighting.terms = SHADE_TERM_EMISSION | SHADE_TERM_SPECULAR;
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, bare);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], k.albedo[0], NULL, with);
        for (int i = 0; i < 3 * SHADE_LANES; i++) CHECK(float_bits(with[i]) == float_bits(bare[i]));
    }
}

/* ------------------------------------------------------------------------------- light, shadows */

/* Every lane has a place of its own; every lane is the equation, L and amount. */
TEST(lanes, light_at_lanes_is_what_arrives_at_each_lane)
{
    static lane_packet k;
    light_sample s;
    long checked = 0, dark = 0;
    for (int round = 0; round < 1500; round++) {
        random_sample(&s);
        double size = d3_length(d3_from(s.P)) * 1e-2 + 1;
        random_packet(&k, &s, size);
        s.lights[0] = random_light(s.P, size);
        shade_vec4 at = s.lights[0].position;
        float L[3 * SHADE_LANES], amount[SHADE_LANES];
        if (at.w == 1) { /* one lane at the lamp itself */
            int i = rnd_int(0, SHADE_LANES - 1);
            k.p[i] = shade_v3(at.x, at.y, at.z);
            lane_set(k.P, i, k.p[i]);
        }
        shade_light_at_lanes(&s.lights[0], k.P[0], L, amount);
        for (int i = 0; i < SHADE_LANES; i++) {
            ref_arrival want = ref_arriving(&s.lights[0], d3_from(k.p[i]));
            shade_vec3 toward = shade_v3(L[i], L[SHADE_LANES + i], L[2 * SHADE_LANES + i]);
            CHECK(finite3(toward) && isfinite(amount[i]));
            check_color(__LINE__, "L", toward, want.L, 1e-6);
            if (want.unsure) continue;
            checked++;
            dark += want.amount == 0;
            CHECK_NEAR(amount[i], want.amount, want.bound);
        }
    }
    CHECK_SAY(checked > 500L * SHADE_LANES && dark > 50L * SHADE_LANES, "%ld, %ld dark", checked,
              dark);
}

/* Either row, both or none; now and then without a light or without positions, which gives
   zeros. */
TEST(lanes, light_at_lanes_writes_the_rows_it_is_given_and_no_more)
{
    static lane_packet k;
    light_sample s;
    struct {
        float before[16], rows[3 * SHADE_LANES], after[16];
    } L, amount;
    for (int round = 0; round < 200; round++) {
        float both[3 * SHADE_LANES], much[SHADE_LANES];
        random_sample(&s);
        random_packet(&k, &s, 2);
        const shade_light *light = round % 5 ? &s.lights[0] : NULL;
        const float *P = round % 7 ? k.P[0] : NULL;
        s.lights[0] = random_light(s.P, 2);
        lane_packet copy = k;
        shade_light_at_lanes(light, P, both, much);
        for (int i = 0; i < SHADE_LANES && !(light && P); i++)
            CHECK(both[i] == 0 && both[SHADE_LANES + i] == 0 && both[2 * SHADE_LANES + i] == 0 &&
                  much[i] == 0);
        memset(&L, CANVAS_BYTE, sizeof L);
        memset(&amount, CANVAS_BYTE, sizeof amount);
        shade_light_at_lanes(light, P, L.rows, NULL);
        shade_light_at_lanes(light, P, NULL, amount.rows);
        shade_light_at_lanes(light, P, NULL, NULL);
        CHECK(!memcmp(L.rows, both, sizeof both) && !memcmp(amount.rows, much, sizeof much));
        for (int i = 0; i < 16; i++) {
            CHECK(float_bits(L.before[i]) == 0xA5A5A5A5u && float_bits(L.after[i]) == 0xA5A5A5A5u);
            CHECK(float_bits(amount.before[i]) == 0xA5A5A5A5u);
        }
        for (int i = SHADE_LANES; i < 3 * SHADE_LANES; i++)
            CHECK(float_bits(amount.rows[i]) == 0xA5A5A5A5u);
        CHECK(!memcmp(&copy, &k, sizeof k));
    }
}

/* The rows of each lamp, in a block of exactly their size. */
static float *random_visibility(int light_count)
{
    static const float plain[] = { 0, 1, 0.5f, 0.25f, 2, -1 };
    float *v = test_memory((size_t)light_count * SHADE_LANES * sizeof *v + 1);
    for (int j = 0; j < light_count; j++) {
        int kind = rnd_int(0, 3); /* in full shadow, in none, either, anything */
        for (int i = 0; i < SHADE_LANES; i++) {
            float any = rnd_one_in(2) ? plain[rnd_int(0, 5)] : rnd_float(-2, 3);
            v[j * SHADE_LANES + i] = kind < 2 ? (float)kind : kind < 3 ? (float)rnd_int(0, 1) : any;
        }
    }
    return v;
}

/* Lamps at infinity, or at points whose w is 1. */
static void random_whole_lamps(light_sample *s)
{
    for (int j = 0; j < s->lighting.light_count; j++) {
        s->lights[j] = random_light(s->P, 3);
        if (s->lights[j].position.w != 0 && s->lights[j].position.w != 1)
            s->lights[j].position = shade_v4(s->P.x + 1, s->P.y, s->P.z, 1);
    }
}

/* The lamps as lane i sees them. */
static void visible_lamps(const light_sample *s, const float *seen, int i, shade_light *lamps)
{
    memcpy(lamps, s->lights, sizeof s->lights);
    for (int j = 0; j < s->lighting.light_count; j++) {
        float v = seen[j * SHADE_LANES + i];
        lamps[j].diffuse = shade_scale(lamps[j].diffuse, v);
        lamps[j].specular = shade_scale(lamps[j].specular, v);
    }
}

/* Against the equation of lamps whose I_d and I_s are multiplied by what is seen of them, lane by
   lane; their ambient light stays, and cool to warm knows no shadow. */
TEST(lanes, visibility_multiplies_the_diffuse_and_specular_light_of_its_lamp)
{
    static lane_packet k;
    light_sample s;
    long sure = 0, attenuated = 0, models[6] = { 0, 0, 0, 0, 0, 0 };
    for (int round = 0; round < 1500; round++) {
        random_sample(&s);
        s.lighting.model = (shade_model)(round % 6);
        if (s.lighting.model == SHADE_MODEL_COOL_TO_WARM)
            s.lighting.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED_ABS;
        random_packet(&k, &s, 1);
        random_whole_lamps(&s);
        float *seen = random_visibility(s.lighting.light_count), rgb[3 * SHADE_LANES];
        int with_albedo = rnd_one_in(2);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0],
                        with_albedo ? k.albedo[0] : NULL, seen, rgb);
        for (int i = 0; i < SHADE_LANES; i++) {
            shade_light lights[sizeof s.lights / sizeof s.lights[0]];
            shade_lighting li = s.lighting;
            visible_lamps(&s, seen, i, lights);
            li.lights = lights;
            shade_vec3 got = shade_v3(rgb[i], rgb[SHADE_LANES + i], rgb[2 * SHADE_LANES + i]);
            d3 albedo = with_albedo ? d3_from(k.a[i]) : d3_of(1, 1, 1);
            ref_lit want = ref_light(&li, &s.material, d3_from(k.p[i]), d3_from(k.n[i]),
                                     d3_from(s.eye), albedo);
            if (want.unsure) continue;
            sure++;
            models[li.model]++;
            attenuated += (li.flags & SHADE_FLAG_ATTENUATED_AMBIENT) && d3_max(want.ambient) > 0;
            if (check_color(__LINE__, "packet", got, want.total, want.bound)) continue;
            s.P = k.p[i];
            s.N = k.n[i];
            print_lights(&s);
        }
        free(seen);
    }
    CHECK_SAY(sure > 750L * SHADE_LANES && attenuated > 30L * SHADE_LANES, "%ld, %ld", sure,
              attenuated);
    for (int m = 0; m < 6; m++) CHECK(models[m] > 50L * SHADE_LANES);
}

TEST(lanes, all_lamps_in_full_sight_are_the_bits_without_visibility)
{
    static lane_packet k;
    light_sample s;
    float ones[4 * SHADE_LANES];
    for (int i = 0; i < 4 * SHADE_LANES; i++) ones[i] = 1;
    for (int round = 0; round < 600; round++) {
        float plain[3 * SHADE_LANES], with[3 * SHADE_LANES];
        random_sample(&s);
        random_packet(&k, &s, 2);
        const float *albedo = round % 2 ? k.albedo[0] : NULL;
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], albedo, NULL, plain);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], albedo, ones, with);
        CHECK(!memcmp(plain, with, sizeof plain));
    }
}

/* Cool to warm and emission know no shadow: not even NaN there changes a bit. */
/* Lamp k gives 2^k, so that the sum says which lamps a lane saw. */
TEST(lanes, each_of_many_lamps_has_its_own_row_of_visibility)
{
    enum { lamps = 11 };
    static float visibility[lamps][SHADE_LANES], P[3][SHADE_LANES], N[3][SHADE_LANES];
    shade_light lights[lamps];
    float rgb[3][SHADE_LANES];
    shade_lighting lighting = { .model = SHADE_MODEL_LAMBERT, .lights = lights,
                                .light_count = lamps };
    for (int k = 0; k < lamps; k++)
        lights[k] = shade_directional_light(shade_v3(0, 0, -1), grey((double)(1 << k)));
    for (int round = 0; round < 20; round++) {
        int want[SHADE_LANES];
        for (int i = 0; i < SHADE_LANES; i++) {
            want[i] = rnd_int(0, (1 << lamps) - 1);
            lane_set(N, i, shade_v3(0, 0, 1));
            for (int k = 0; k < lamps; k++) visibility[k][i] = (float)(want[i] >> k & 1);
        }
        lit_rows(&lighting, NULL, shade_v3(0, 0, 9), P[0], N[0], NULL, visibility[0], rgb[0]);
        for (int i = 0; i < SHADE_LANES; i++) CHECK_NEAR(rgb[0][i], want[i], 1e-2);
    }
}

/* The rows are NaN, which would show in every colour that they touch. */
TEST(lanes, models_without_light_of_lamps_read_no_visibility)
{
    static lane_packet k;
    light_sample s;
    float none[4 * SHADE_LANES];
    for (int i = 0; i < 4 * SHADE_LANES; i++) none[i] = (float)NAN;
    for (int round = 0; round < 300; round++) {
        float plain[3 * SHADE_LANES], with[3 * SHADE_LANES];
        random_sample(&s);
        random_packet(&k, &s, 2);
        s.lighting.model = round % 2 ? SHADE_MODEL_COOL_TO_WARM : SHADE_MODEL_EMISSIVE;
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, plain);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, none, with);
        CHECK(!memcmp(plain, with, sizeof plain));
    }
}

/* G1 */
TEST(lanes, nothing_is_written_but_the_three_rows)
{
    static lane_packet k;
    light_sample s;
    struct {
        float before[16], rgb[3 * SHADE_LANES], after[16];
    } box;
    for (int round = 0; round < 200; round++) {
        random_sample(&s);
        random_packet(&k, &s, 2);
        lane_packet copy = k;
        memset(&box, CANVAS_BYTE, sizeof box);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], k.albedo[0], NULL,
                        box.rgb);
        for (int i = 0; i < 16; i++) {
            CHECK(float_bits(box.before[i]) == 0xA5A5A5A5u &&
                  float_bits(box.after[i]) == 0xA5A5A5A5u);
        }
        CHECK(!memcmp(&copy, &k, sizeof k));
    }
}

TEST(lanes, missing_arguments_mean_their_defaults)
{
    static lane_packet k;
    light_sample s;
    random_sample(&s);
    random_packet(&k, &s, 2);
    float rgb[3 * SHADE_LANES];
    lit_rows(NULL, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb);
    for (int i = 0; i < 3 * SHADE_LANES; i++) CHECK(rgb[i] == 0);
    shade_lighting li = { .ambient = shade_v3(0.25f, 0.5f, 0.75f) };
    lit_rows(&li, NULL, s.eye, k.P[0], k.N[0], NULL, NULL, rgb);
    for (int i = 0; i < 3 * SHADE_LANES; i++)
        CHECK_NEAR(rgb[i], 0.25 * (1 + i / SHADE_LANES), 1e-7);
    li.lights = NULL;
    li.light_count = 3;
    lit_rows(&li, NULL, s.eye, k.P[0], k.N[0], NULL, NULL, rgb);
    for (int i = 0; i < 3 * SHADE_LANES; i++)
        CHECK_NEAR(rgb[i], 0.25 * (1 + i / SHADE_LANES), 1e-7);
    for (int row = 0; row < 2; row++) {
        for (int i = 0; i < 3 * SHADE_LANES; i++) rgb[i] = 7;
        lit_rows(&li, NULL, s.eye, row ? k.P[0] : NULL, row ? NULL : k.N[0], NULL, NULL,
                        rgb);
        for (int i = 0; i < 3 * SHADE_LANES; i++) CHECK_NEAR(rgb[i], 0, 0);
    }
    lane_packet before = k;
    lit_rows(&li, NULL, s.eye, k.P[0], k.N[0], k.albedo[0], NULL,
                    NULL); /* nowhere to write */
    CHECK(!memcmp(&before, &k, sizeof k));
}

/* L = -V exactly: no halfway vector, so no highlight, whatever the exponent and the gate */
/* G3 */
TEST(lanes, light_opposite_to_the_viewer_has_no_halfway_vector)
{
    static lane_packet k;
    float rgb[3 * SHADE_LANES];
    for (int round = 0; round < 8; round++) {
        shade_light light = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
        shade_lighting li = { 0 };
        shade_material m = { 0 };
        li.lights = &light;
        li.light_count = 1;
        li.flags = round & 1 ? SHADE_FLAG_INFINITE_VIEWER : 0;
        if (round & 2) li.flags |= SHADE_FLAG_UNGATED_SPECULAR;
        m.specular = shade_v3(1, 1, 1);
        m.shininess = round & 4 ? 5 : 0;
        for (int i = 0; i < SHADE_LANES; i++) { /* every other lane: seen from beside the lamp */
            lane_set(k.P, i, i % 2 && !(round & 1) ? shade_v3(3, 0, -3) : shade_v3(0, 0, 0));
            lane_set(k.N, i, shade_v3(0, 0.6f, 0.8f));
        }
        lit_rows(&li, &m, shade_v3(0, 0, -1), k.P[0], k.N[0], NULL, NULL, rgb);
        for (int i = 0; i < 3 * SHADE_LANES; i++) {
            if (i % 2 && !(round & 1)) CHECK(rgb[i] > 0);
            else CHECK_NEAR(rgb[i], 0, 0);
        }
    }
}

/* More lights than are prepared once for a draw. */
TEST(lanes, many_lights_add_up)
{
    static lane_packet k;
    static shade_light lights[100];
    light_sample s;
    for (int round = 0; round < 30; round++) {
        random_sample(&s);
        s.P = shade_v3(0, 0, 0);
        s.lighting.model = SHADE_MODEL_BLINN_PHONG;
        s.lighting.flags = 0;
        s.lighting.terms = 0;
        random_packet(&k, &s, 1);
        for (int j = 0; j < 100; j++) {
            lights[j] = random_light(s.P, 10);
            if (lights[j].position.w != 0 && lights[j].position.w != 1) lights[j].position.w = 1;
        }
        s.lighting.lights = lights;
        s.lighting.light_count = rnd_int(5, 100);
        check_packet(&s, &k, 0);
    }
}

TEST(lanes, a_lamp_without_an_axis_is_no_spot) /* whatever the exponent says */
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 60; round++) {
        random_sample(&s);
        random_packet(&k, &s, d3_length(d3_from(s.P)) * 1e-2 + 1);
        float rgb[2][3 * SHADE_LANES] = {{0}}; /* without a cone's figures, with them */
        for (int pass = 0; pass < 2; pass++) {
            for (int j = 0; j < s.lighting.light_count; j++) {
                s.lights[j].spot_direction = shade_v3(0, 0, 0);
                s.lights[j].spot_exponent = pass ? 0.5f + (float)j : 0;
                s.lights[j].spot_cos_cutoff = pass ? 0.75f : 0;
            }
            lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb[pass]);
        }
        CHECK(!memcmp(rgb[0], rgb[1], sizeof rgb[0]));
    }
}

/* The rows are NaN and infinite, which even a factor of 0 would not hide. */
TEST(lanes, emission_alone_reads_no_albedo)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 20; round++) {
        float rgb[3 * SHADE_LANES];
        random_sample(&s);
        random_packet(&k, &s, 1);
        for (int i = 0; i < 3 * SHADE_LANES; i++)
            k.albedo[i / SHADE_LANES][i % SHADE_LANES] = (float)(i % 2 ? NAN : INFINITY);
        s.lighting.model = SHADE_MODEL_EMISSIVE;
        s.lighting.terms = 0;
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], k.albedo[0], NULL, rgb);
        for (int i = 0; i < SHADE_LANES; i++) {
            CHECK_NEAR(rgb[i], s.material.emission.x, 0);
            CHECK_NEAR(rgb[SHADE_LANES + i], s.material.emission.y, 0);
            CHECK_NEAR(rgb[2 * SHADE_LANES + i], s.material.emission.z, 0);
        }
    }
}

/* One lane is made wild, and the others keep their bits; then the lights and the material are. */
/* G14 */
TEST(lanes, nan_and_infinity_never_crash_and_stay_in_their_lane)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 600; round++) {
        random_sample(&s);
        random_packet(&k, &s, 2);
        float one[3 * SHADE_LANES], other[3 * SHADE_LANES];
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, one);
        int hit = rnd_int(0, SHADE_LANES - 1);
        float v[6];
        fill_nasty(v, sizeof v);
        lane_set(k.P, hit, shade_v3(v[0], v[1], v[2]));
        lane_set(k.N, hit, shade_v3(v[3], v[4], v[5]));
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, other);
        for (int i = 0; i < 3 * SHADE_LANES; i++) {
            if (i % SHADE_LANES != hit) CHECK(float_bits(one[i]) == float_bits(other[i]));
        }
        if (round % 4) continue;
        fill_nasty(s.lights, sizeof s.lights);
        fill_nasty(&s.material, sizeof s.material);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, other);
    }
}

/* -------------------------------------------------------------------------------- shade_rows */

/* The specular row multiplies k_s of its lane, and the rows that are NULL are 1: every combination
   of the three, with the visibility of each lamp taken into its light. */
typedef struct lane_rows {
    lane_packet k;
    float specular[3][SHADE_LANES], visibility[4][SHADE_LANES];
    light_sample s;
    shade_rows rows;
} lane_rows;
static void random_rows(lane_rows *r, int combination)
{
    random_sample(&r->s);
    random_packet(&r->k, &r->s, d3_length(d3_from(r->s.P)) * 1e-2 + 1);
    for (int i = 0; i < 3 * SHADE_LANES; i++)
        r->specular[i / SHADE_LANES][i % SHADE_LANES] = rnd_one_in(8) ? 0 : rnd_float(0, 1);
    for (int i = 0; i < 4 * SHADE_LANES; i++)
        r->visibility[i / SHADE_LANES][i % SHADE_LANES] = rnd_one_in(4) ? 0 : rnd_float(0, 1);
    memset(&r->rows, 0, sizeof r->rows);
    r->rows.position = r->k.P[0];
    r->rows.normal = r->k.N[0];
    if (combination & 1) r->rows.albedo = r->k.albedo[0];
    if (combination & 2) r->rows.specular = r->specular[0];
    if (combination & 4) r->rows.visibility = r->visibility[0];
}

/* What a lane is lit with, as material and lamps of its own; its albedo is the oracle's. */
static ref_lit ref_lane(const lane_rows *r, int i)
{
    shade_light lamps[4];
    shade_lighting lighting = r->s.lighting;
    shade_material m = r->s.material;
    d3 albedo = r->rows.albedo ? d3_from(r->k.a[i]) : d3_of(1, 1, 1);
    if (r->rows.specular)
        m.specular = shade_mul(m.specular, shade_v3(r->specular[0][i], r->specular[1][i],
                                                    r->specular[2][i]));
    for (int j = 0; j < lighting.light_count && r->rows.visibility; j++) {
        float seen = lighting.model == SHADE_MODEL_COOL_TO_WARM ? 1 : r->visibility[j][i];
        lamps[j] = lighting.lights[j];
        lamps[j].diffuse = shade_scale(lamps[j].diffuse, seen);
        lamps[j].specular = shade_scale(lamps[j].specular, seen);
    }
    if (r->rows.visibility) lighting.lights = lamps;
    return ref_light(&lighting, &m, d3_from(r->k.p[i]), d3_from(r->k.n[i]), d3_from(r->s.eye),
                     albedo);
}

/* The eight sets of albedo, specular colour and visibility in turn, against the equation with
   the material and lamps of that lane. */
TEST(lanes, every_combination_of_rows_is_the_equation_of_its_lane)
{
    static lane_rows r;
    long sure = 0, tinted = 0;
    for (int round = 0; round < 800; round++) {
        float rgb[3][SHADE_LANES];
        random_rows(&r, round % 8);
        for (int j = 0; j < r.s.lighting.light_count; j++)
            if (r.s.lights[j].position.w != 0) r.s.lights[j].position.w = 1;
        if (r.s.lighting.light_count > 4) r.s.lighting.light_count = 4;
        shade_lit_lanes(&r.s.lighting, &r.s.material, r.s.eye, &r.rows, rgb[0]);
        for (int i = 0; i < SHADE_LANES; i++) {
            ref_lit want = ref_lane(&r, i);
            if (want.unsure) continue;
            check_color(__LINE__, "lane", shade_v3(rgb[0][i], rgb[1][i], rgb[2][i]), want.total,
                        want.bound);
            sure++;
            tinted += r.rows.specular && d3_max(want.specular) > 0.01;
        }
    }
    CHECK_SAY(sure > 300 * SHADE_LANES && tinted > 10 * SHADE_LANES, "%ld, %ld", sure, tinted);
}

/* each lane by shade_lit, with the products of its rows as its material */
TEST(lanes, a_lane_of_rows_has_the_bits_of_the_scalar_call_where_rows_are_powers_of_two)
{
    static lane_rows r;
    for (int round = 0; round < 200; round++) {
        float rgb[3][SHADE_LANES];
        random_rows(&r, round % 4);
        for (int i = 0; i < 3 * SHADE_LANES; i++) {
            r.k.albedo[i / SHADE_LANES][i % SHADE_LANES] = ldexpf(1, rnd_int(-4, 2));
            r.specular[i / SHADE_LANES][i % SHADE_LANES] = ldexpf(1, rnd_int(-4, 2));
        }
        shade_lit_lanes(&r.s.lighting, &r.s.material, r.s.eye, &r.rows, rgb[0]);
        for (int i = 0; i < SHADE_LANES; i += 3) {
            shade_material m = r.s.material;
            shade_vec3 a = shade_v3(r.k.albedo[0][i], r.k.albedo[1][i], r.k.albedo[2][i]);
            if (!r.rows.albedo) a = shade_v3(1, 1, 1);
            m.ambient = shade_mul(m.ambient, a);
            m.diffuse = shade_mul(m.diffuse, a);
            a = shade_v3(r.specular[0][i], r.specular[1][i], r.specular[2][i]);
            if (r.rows.specular) m.specular = shade_mul(m.specular, a);
            if (r.s.lighting.model == SHADE_MODEL_COOL_TO_WARM) break; /* a ramp is no k_d */
            shade_vec3 c = shade_lit(&r.s.lighting, &m, r.s.eye, r.k.p[i], r.k.n[i]);
            shade_vec3 got = shade_v3(rgb[0][i], rgb[1][i], rgb[2][i]);
            double apart = d3_length(d3_sub(d3_from(c), d3_from(got)));
            CHECK((c.x == got.x && c.y == got.y && c.z == got.z) ||
                  (apart < 1e-42 && d3_length(d3_from(c)) < 1e-35)); /* denormal products */
        }
    }
}

TEST(lanes, what_a_call_of_rows_cannot_do_without_gives_black_and_no_other_byte)
{
    static lane_rows r;
    random_rows(&r, 7);
    for (int k = 0; k < 5; k++) {
        float rgb[5][SHADE_LANES];
        shade_rows rows = r.rows;
        memset(rgb, CANVAS_BYTE, sizeof rgb);
        if (k == 2) rows.position = NULL;
        if (k == 3) rows.normal = NULL;
        shade_lit_lanes(k == 0 ? NULL : &r.s.lighting, &r.s.material, r.s.eye,
                        k == 1 ? NULL : &rows, k == 4 ? NULL : rgb[1]);
        for (int i = 0; i < 5 * SHADE_LANES; i++) {
            int black = k < 4 && i / SHADE_LANES > 0 && i / SHADE_LANES < 4;
            CHECK(float_bits(rgb[i / SHADE_LANES][i % SHADE_LANES]) == (black ? 0 : 0xA5A5A5A5u));
        }
    }
}

/* --------------------------------------------------------------- a lane depends on itself alone */

/* A lane depends on itself alone: its light, texel and pixel are the same bits whatever the
   other lanes of its packet hold, infinities and NaN included, and those of the scalar call. A
   NaN equals a NaN: its sign and its other bits are not promised.

   The scalar calls run the build for any processor, the packets that of this one, so that both
   meet here as well. */

static int alone_same(float a, float b)
{
    return float_bits(a) == float_bits(b) || (isnan(a) && isnan(b));
}

/* Makes about one float of n nasty. */
static void alone_spoil(void *memory, size_t bytes, int n)
{
    for (size_t at = 0; at + 4 <= bytes; at += 4) {
        float v = rnd_nasty();
        if (rnd_one_in(n)) memcpy((char *)memory + at, &v, 4);
    }
}

static void alone_spoil_colors(light_sample *s)
{
    alone_spoil(&s->material, sizeof s->material, 8);
    alone_spoil(&s->lighting.ambient, sizeof s->lighting.ambient, 8);
    for (int k = 0; k < s->lighting.light_count; k++) {
        shade_light *l = &s->lights[k];
        alone_spoil(&l->ambient, sizeof l->ambient, 8);
        alone_spoil(&l->diffuse, sizeof l->diffuse, 8);
        alone_spoil(&l->specular, sizeof l->specular, 8);
    }
}

static void alone_spoil_lamps(light_sample *s)
{
    for (int k = 0; k < s->lighting.light_count; k++) {
        shade_light *l = &s->lights[k];
        float *const falls[] = { &l->constant, &l->linear, &l->quadratic, &l->spot_exponent,
                                 &l->spot_cos_cutoff };
        alone_spoil(&l->position, sizeof l->position, 12);
        alone_spoil(&l->spot_direction, sizeof l->spot_direction, 12);
        for (int i = 0; i < 5; i++) alone_spoil(falls[i], 4, 12);
    }
}

/* Every model and flag; ordinary, with wild colours, or with wild lamps too; some lanes look nearly
   at the lamp from behind, some are wild. */
static void alone_sample(light_sample *s, lane_packet *k)
{
    random_sample(s);
    random_packet(k, s, d3_length(d3_from(s->P)) * 1e-2 + 1);
    if (s->lighting.light_count && rnd_one_in(2)) {
        double r;
        d3 L = ref_to_light(&s->lights[0], d3_from(s->P), &r);
        d3 V = d3_add(d3_scale(L, -1), d3_scale(rnd_direction(), (double)rnd_log(1e-8, 0.2)));
        d3 from = s->lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? d3_of(0, 0, 0) : d3_from(s->P);
        s->eye = d3_round(d3_add(from, d3_scale(V, 1 + d3_length(d3_from(s->P)))));
    }
    if (!rnd_one_in(3)) alone_spoil_colors(s);
    if (rnd_one_in(3)) alone_spoil_lamps(s);
    for (int i = 0; i < SHADE_LANES; i++) {
        if (rnd_one_in(3)) alone_spoil(&k->p[i], sizeof k->p[i], 12);
        if (rnd_one_in(3)) alone_spoil(&k->n[i], sizeof k->n[i], 12);
        lane_set(k->P, i, k->p[i]);
        lane_set(k->N, i, k->n[i]);
    }
}

/* G14 */
TEST(lanes, a_lane_of_a_packet_is_the_scalar_call)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 900; round++) {
        float rgb[3][SHADE_LANES];
        alone_sample(&s, &k);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb[0]);
        for (int i = 0; i < SHADE_LANES; i += 2) {
            shade_vec3 one = shade_lit(&s.lighting, &s.material, s.eye, k.p[i], k.n[i]);
            CHECK_SAY(alone_same(rgb[0][i], one.x) && alone_same(rgb[1][i], one.y) &&
                          alone_same(rgb[2][i], one.z),
                      "model %d flags %u lane %d: %a %a %a, alone %a %a %a", (int)s.lighting.model,
                      s.lighting.flags, i, (double)rgb[0][i], (double)rgb[1][i], (double)rgb[2][i],
                      (double)one.x, (double)one.y, (double)one.z);
        }
    }
}

/* The rows of a packet that has albedo, specular rows and visibility, each perhaps. */
typedef struct alone_rows {
    float albedo[3][SHADE_LANES], specular[3][SHADE_LANES], visible[4][SHADE_LANES];
    float P[3][SHADE_LANES], N[3][SHADE_LANES];
} alone_rows;
static void alone_fill(float *row, int n)
{
    for (int i = 0; i < n * SHADE_LANES; i++) {
        row[i] = rnd_one_in(3) ? (float)rnd_int(0, 1) : rnd_float(0, 1);
        if (rnd_one_in(20)) row[i] = rnd_nasty();
    }
}

/* Every lane becomes lane i. */
static void alone_copies(const alone_rows *from, int i, alone_rows *to)
{
    const float *v = (const float *)from;
    float *all = (float *)to;
    for (size_t row = 0; row < sizeof *to / 4; row += SHADE_LANES)
        for (size_t j = 0; j < SHADE_LANES; j++) all[row + j] = v[row + (size_t)i];
}

static shade_rows alone_pointers(const alone_rows *r, int which)
{
    shade_rows rows = { r->P[0], r->N[0], NULL, NULL, NULL };
    if (which & 1) rows.albedo = r->albedo[0];
    if (which & 2) rows.specular = r->specular[0];
    if (which & 4) rows.visibility = r->visible[0];
    return rows;
}

/* G14 */
TEST(lanes, a_lane_among_others_is_the_lane_among_copies_of_itself)
{
    static lane_packet k;
    static alone_rows rows, copies;
    light_sample s;
    for (int round = 0; round < 500; round++) {
        float rgb[3][SHADE_LANES], alone[3][SHADE_LANES];
        const int which = rnd_int(0, 7);
        alone_sample(&s, &k);
        alone_fill(rows.albedo[0], 10);
        memcpy(rows.P, k.P, sizeof k.P);
        memcpy(rows.N, k.N, sizeof k.N);
        shade_rows all = alone_pointers(&rows, which), one = alone_pointers(&copies, which);
        shade_lit_lanes(&s.lighting, &s.material, s.eye, &all, rgb[0]);
        for (int i = round % 8; i < SHADE_LANES; i += 8) {
            alone_copies(&rows, i, &copies);
            shade_lit_lanes(&s.lighting, &s.material, s.eye, &one, alone[0]);
            for (int c = 0; c < 3; c++)
                CHECK_SAY(alone_same(rgb[c][i], alone[c][0]),
                          "model %d flags %u rows %d lane %d: %a, alone %a", (int)s.lighting.model,
                          s.lighting.flags, which, i, (double)rgb[c][i], (double)alone[c][0]);
        }
    }
}

/* G14 */
TEST(lanes, what_arrives_at_a_lane_is_what_arrives_at_the_point)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 1500; round++) {
        float L[3][SHADE_LANES], amount[SHADE_LANES];
        alone_sample(&s, &k);
        shade_light_at_lanes(&s.lights[0], k.P[0], L[0], amount);
        for (int i = 0; i < SHADE_LANES; i += 3) {
            shade_vec3 to_light;
            float one = shade_light_at(&s.lights[0], k.p[i], &to_light, NULL);
            CHECK_SAY(float_bits(amount[i]) == float_bits(one), "lane %d: %a, alone %a", i,
                      (double)amount[i], (double)one);
            CHECK(alone_same(L[0][i], to_light.x) && alone_same(L[1][i], to_light.y) &&
                  alone_same(L[2][i], to_light.z));
        }
    }
}

/* A texture of wild floats or of any bytes, each level as wild. */
/* G14 */
TEST(lanes, a_texel_of_a_packet_is_the_scalar_sample)
{
    for (int round = 0; round < 600; round++) {
        float u[SHADE_LANES], v[SHADE_LANES], lod[SHADE_LANES], rgba[4][SHADE_LANES];
        shade_texture levels[16], t = random_texture(40);
        if (t.format == SHADE_FORMAT_RGBA32F)
            alone_spoil((void *)(uintptr_t)t.pixels, texture_cells(&t) * 16, 6);
        void *memory = rnd_one_in(2) ? add_mipmaps(&t, levels) : NULL;
        for (int i = 0; i < SHADE_LANES; i++) {
            u[i] = random_coordinate();
            v[i] = random_coordinate();
            lod[i] = rnd_float(-1, 7);
            if (rnd_one_in(10)) u[i] = rnd_nasty();
            if (rnd_one_in(10)) v[i] = rnd_nasty();
            if (rnd_one_in(10)) lod[i] = rnd_nasty();
        }
        const int with_lod = !rnd_one_in(5);
        shade_sample_lanes(&t, u, v, with_lod ? lod : NULL, rgba[0]);
        for (int i = 0; i < SHADE_LANES; i++) {
            shade_vec4 one = shade_sample(&t, u[i], v[i], with_lod ? lod[i] : 0);
            CHECK_SAY(alone_same(rgba[0][i], one.x) && alone_same(rgba[1][i], one.y) &&
                          alone_same(rgba[2][i], one.z) && alone_same(rgba[3][i], one.w),
                      "format %d filter %d at %a %a lod %a: %a, alone %a", (int)t.format,
                      (int)t.filter, (double)u[i], (double)v[i], (double)lod[i],
                      (double)rgba[0][i], (double)one.x);
        }
        free(memory);
        free_texture(&t);
    }
}

/* ------------------------------------------------------------------------------- whole pictures */

enum { ALONE_W = 48, ALONE_H = 32 };

/* A bent sheet, its lights and its colours wild, drawn as the clip rectangle allows. */
typedef struct alone_scene {
    light_sample light;
    float P[25][3], N[25][3], color[25][3], uv[25][2];
    uint32_t index[96];
    shade_mesh mesh;
    shade_draw_state state;
} alone_scene;
static void alone_sheet(alone_scene *a)
{
    memset(a, 0, sizeof *a);
    for (int i = 0; i < 25; i++) {
        a->P[i][0] = (float)(i % 5) - 2;
        a->P[i][1] = (float)(i / 5) - 2;
        a->P[i][2] = rnd_float(-0.5, 0.5);
        shade_vec3 n = d3_round(d3_add(d3_of(0, 0, 1), d3_scale(rnd_direction(), 1.2)));
        memcpy(a->N[i], &n, 12);
        for (int c = 0; c < 3; c++) a->color[i][c] = rnd_one_in(6) ? rnd_nasty() : rnd_float(0, 1);
        for (int c = 0; c < 2; c++) a->uv[i][c] = rnd_one_in(40) ? rnd_nasty() : rnd_float(-1, 2);
    }
    for (int k = 0; k < 32; k++) {
        const uint32_t at = (uint32_t)(k / 2 % 4 + k / 8 * 5);
        const uint32_t corner[2][3] = { { at, at + 1, at + 6 }, { at, at + 6, at + 5 } };
        memcpy(a->index + 3 * k, corner[k % 2], sizeof corner[0]);
    }
    a->mesh.positions = a->P[0];
    a->mesh.normals = a->N[0];
    a->mesh.vertex_count = 25;
    a->mesh.indices = a->index;
    a->mesh.index_count = 96;
}

static void alone_lights(alone_scene *a)
{
    light_sample *s = &a->light;
    random_sample(s);
    s->lighting.light_count = rnd_int(1, 4);
    for (int k = 0; k < s->lighting.light_count; k++)
        s->lights[k] = random_light(shade_v3(0, 0, 0), 3);
    alone_spoil_colors(s);
    if (rnd_one_in(3)) alone_spoil_lamps(s);
    a->state.lighting = s->lighting;
    a->state.material = &s->material;
    a->state.lighting.lights = s->lights;
}

static void alone_check_pixels(const canvas *whole, const canvas *parts, const char *how)
{
    const size_t bytes = canvas_pixel_bytes(whole->target.format);
    for (int i = 0; i < ALONE_W * ALONE_H; i++) {
        const int x = i % ALONE_W, y = i / ALONE_W;
        int same = !memcmp(canvas_pixel(whole, x, y), canvas_pixel(parts, x, y), bytes);
        if (bytes == 16) {
            same = 1;
            for (int c = 0; c < 4; c++)
                same &= alone_same(canvas_float(whole, x, y, c), canvas_float(parts, x, y, c));
        }
        CHECK_SAY(same, "pixel %d %d by %s", x, y, how);
        CHECK(float_bits(canvas_depth(whole, x, y)) == float_bits(canvas_depth(parts, x, y)));
    }
}

static canvas alone_draw(const alone_scene *a, shade_format format, int w, int h)
{
    canvas c = canvas_ready(ALONE_W, ALONE_H, 0, format, 1);
    for (int y = 0; y < ALONE_H; y += h) {
        for (int x = 0; x < ALONE_W; x += w) {
            c.target.clip_x = x;
            c.target.clip_y = y;
            c.target.clip_width = w;
            c.target.clip_height = h;
            canvas_draw_mesh(&c, &a->mesh, &a->state);
        }
    }
    return c;
}

/* A clip rectangle of one pixel leaves its lane no neighbours; light, colours and texture
   coordinates may be NaN or infinite. */
/* G13, G14 */
TEST(lanes, a_picture_is_the_same_in_bands_and_pixel_by_pixel)
{
    for (int round = 0; round < 36; round++) {
        static alone_scene a;
        shade_texture levels[16], map = random_texture(16);
        const shade_format format = round % 2 ? SHADE_FORMAT_RGBA32F : SHADE_FORMAT_RGBA8;
        alone_sheet(&a);
        alone_lights(&a);
        void *memory = add_mipmaps(&map, levels);
        a.state.shading = (shade_shading)(round % 3);
        if (rnd_one_in(2)) a.mesh.colors = a.color[0];
        if (rnd_one_in(2)) {
            a.mesh.texcoords = a.uv[0];
            a.state.diffuse_map = &map;
        }
        a.state.view = shade_mat4_look_at(shade_v3(1, 1, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        a.state.projection = shade_mat4_perspective(0.9f, 1.5f, 1, 20);
        a.state.raster.cull = SHADE_CULL_NONE;
        canvas whole = alone_draw(&a, format, ALONE_W, ALONE_H);
        canvas bands = alone_draw(&a, format, ALONE_W, 3);
        canvas pixels = alone_draw(&a, format, 1, 1);
        alone_check_pixels(&whole, &bands, "bands");
        alone_check_pixels(&whole, &pixels, "pixels");
        canvas_close(&whole);
        canvas_close(&bands);
        canvas_close(&pixels);
        free(memory);
        free_texture(&map);
    }
}

/* -0 stays, or becomes +0, whether another lane is lit or none. */
/* G14 */
TEST(lanes, a_colour_of_minus_zero_is_the_same_beside_a_lit_lane)
{
    static float P[3][SHADE_LANES], N[3][SHADE_LANES], albedo[3][SHADE_LANES];
    shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_material m = shade_preset_material(SHADE_PRESET_COUNT);
    float rgb[2][3][SHADE_LANES];
    shade_lighting lighting = { .lights = &lamp, .light_count = 1, .ambient = shade_v3(1, 1, 1) };
    m.emission = shade_v3(-0.0f, -0.0f, -0.0f);
    for (int lit = 0; lit < 2; lit++) {
        for (int i = 0; i < SHADE_LANES; i++) {
            lane_set(N, i, shade_v3(0, 0, lit && i > 0 ? 1.0f : -1.0f));
            lane_set(albedo, i, shade_v3(-0.0f, -0.0f, -0.0f));
        }
        lit_rows(&lighting, &m, shade_v3(0, 0, 9), P[0], N[0], albedo[0], NULL, rgb[lit][0]);
    }
    for (int c = 0; c < 3; c++) CHECK(float_bits(rgb[0][c][0]) == float_bits(rgb[1][c][0]));
}

/* ------------------------------------------------------------------------------------------ NaN */

/* The NaN that an operation makes is positive on some processors and negative on others. */
/* G14 */
TEST(lanes, the_sign_of_a_nan_decides_nothing)
{
    const float nan[2] = { bits_float(0x7FC00000u), bits_float(0xFFC00001u) };
    shade_light lamp = shade_point_light(shade_v3(0, 3, 0), shade_v3(1, 1, 1));
    static const float texel[4][4] = { { 1 }, { 2 }, { 3 }, { 4 } };
    shade_texture t = { .pixels = texel, .width = 4, .height = 1, .format = SHADE_FORMAT_RGBA32F };
    for (int falls = 0; falls < 2; falls++) {
        lamp.quadratic = (float)falls;
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(nan[0], 0, 0), NULL, NULL), 0, 1e-30);
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(nan[1], 0, 0), NULL, NULL), 0, 1e-30);
    }
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(shade_power(nan[k], 2), 0, 0);
        CHECK_NEAR(shade_power(0.5f, nan[k]), 1, 0);
        CHECK_NEAR(shade_attenuation(1, nan[k], 0, 1), 1e20, 1e14);
        lamp.quadratic = nan[k];
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(0, 0, 0), NULL, NULL), 1e20, 1e14);
        lamp.quadratic = 0;
        lamp.constant = nan[k];
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(0, 0, 0), NULL, NULL), 1e20, 1e14);
        lamp.constant = 0;
        for (int wrap = 0; wrap < 3; wrap++) {
            t.wrap_u = (shade_wrap)wrap;
            CHECK_NEAR(shade_sample(&t, nan[k], 0.5f, 0).x, shade_sample(&t, 0, 0.5f, 0).x, 0);
        }
    }
}

/* What the sum of the coefficients makes of finite ones: -inf + inf, whose sign differs between
   processors; and a square of the distance that overflows beside a coefficient of 0. */
/* G3 */
TEST(lanes, a_distance_or_a_sum_that_overflows_has_one_outcome)
{
    shade_light lamp = shade_point_light(shade_v3(0, 0, 0), shade_v3(1, 1, 1));
    lamp.linear = -1e30f;
    lamp.quadratic = 1e30f;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e12f, 0, 0), NULL, NULL), 1e20, 1e14);
    lamp.linear = 1;
    lamp.quadratic = 0;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e18f, 0, 0), NULL, NULL), 1e-18, 1e-23);
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e30f, 0, 0), NULL, NULL), 0, 2e-18);
    lamp.quadratic = 1e30f;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e18f, 0, 0), NULL, NULL), 0, 0);
}
