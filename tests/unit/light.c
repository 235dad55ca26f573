/* light.c - the equations of light, against double precision over the whole legal range, and
   against numbers worked out from them. */
#include "unit.h"

/* --------------------------------------------------------------------------- random legal input */

static d3 no_albedo(void) { return d3_of(1, 1, 1); }

/* Enough samples that each of the models, flags and kinds of light meets each other many times. */
/* G18 */
TEST(light, evaluate_and_lit_match_the_equation_for_every_flag_and_model)
{
    light_sample s;
    int sure = 0, lit = 0;
    for (int i = 0; i < 200000; i++) {
        random_sample(&s);
        ref_lit want = ref_of_sample(&s);
        shade_terms got = shade_evaluate(&s.lighting, &s.material, s.eye, s.P, s.N);
        shade_vec3 sum = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        CHECK(finite3(sum));
        if (want.unsure) continue;
        sure++;
        lit += d3_max(want.specular) > 1e-3;
        int ok = check_color(__LINE__, "emission", got.emission, want.emission, want.bound);
        ok &= check_color(__LINE__, "ambient", got.ambient, want.ambient, want.bound);
        ok &= check_color(__LINE__, "diffuse", got.diffuse, want.diffuse, want.bound);
        ok &= check_color(__LINE__, "specular", got.specular, want.specular, want.bound);
        ok &= check_color(__LINE__, "shade_lit", sum, want.total, want.bound);
        if (!ok) print_lights(&s);
    }
    CHECK_SAY(sure > 150000 && lit > 20000, "%d samples, %d with a highlight", sure, lit);
}

/* A unit vector with cosine c to the unit vector v. */
static d3 d3_at_cosine(d3 v, double c)
{
    d3 aside;
    do aside = d3_cross(v, rnd_direction());
    while (d3_length(aside) < 1e-2);
    return d3_add(d3_scale(v, c), d3_scale(d3_unit(aside), sqrt(1 - c * c)));
}

static double random_brink(void) { return (double)(rnd_sign() * rnd_log(1e-6, 1e-5)); }
static float random_factor(void) { return rnd_one_in(2) ? 0 : rnd_log(1e-35, 1e35); }

/* One lamp, full of what the bound of shade.h allows: N.L, L.S - cos(beta) and N.V within 1e-5 of a
   jump, L + V short, coefficients of attenuation of any size. */
static void random_brink_sample(light_sample *s)
{
    memset(s, 0, sizeof *s);
    double size = (double)rnd_log(1e-3, 1e9), r;
    shade_light *l = &s->lights[0];
    s->P = rnd_one_in(4) ? shade_v3(0, 0, 0) : random_vector(size);
    s->material = random_material();
    l->diffuse = random_color(1e6);
    l->specular = random_color((double)rnd_log(1e-3, 1e6));
    l->ambient = random_color(1e6);
    int infinite = rnd_one_in(3);
    d3 far = d3_scale(rnd_direction(), infinite ? (double)rnd_log(1e-12, 1e12)
                                                : size * (double)rnd_log(1e-5, 1));
    shade_vec3 p = d3_round(infinite ? far : d3_add(d3_from(s->P), far));
    l->position = shade_v4(p.x, p.y, p.z, infinite ? 0 : 1);
    l->constant = random_factor();
    l->linear = random_factor();
    l->quadratic = random_factor();
    d3 L = ref_to_light(l, d3_from(s->P), &r);
    d3 N = d3_at_cosine(L, rnd_one_in(2) ? random_brink() : 2 * rnd_unit() - 1);
    s->N = d3_round(d3_scale(N, (double)rnd_log(1e-15, 1e15)));
    if (rnd_one_in(2)) {
        double near_axis = 1 - (double)rnd_log(1e-7, 1);
        double LS = rnd_one_in(2) ? near_axis : (double)(rnd_sign() * rnd_log(1e-6, 1));
        d3 S = d3_at_cosine(L, LS);
        l->spot_direction = d3_round(d3_scale(S, -(double)rnd_log(1e-10, 1e10)));
        l->spot_cos_cutoff = rnd_one_in(2) ? -1 : (float)(LS + random_brink());
        l->spot_exponent = rnd_one_in(3) ? 0 : random_exponent();
    }
    d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L), V = rnd_direction();
    switch (rnd_int(0, 3)) {
    case 0: V = d3_at_cosine(N, random_brink()); break;
    case 1: V = d3_add(R, d3_scale(V, (double)rnd_log(1e-4, 1))); break;
    case 2: V = d3_sub(d3_scale(rnd_one_in(2) ? N : V, (double)rnd_log(1e-6, 1e-2)), L); break;
    default: break;
    }
    s->lighting.lights = s->lights;
    s->lighting.light_count = 1;
    s->lighting.model = (shade_model)rnd_int(0, 1);
    s->lighting.flags = (unsigned)rnd_int(0, 63);
    d3 from = s->lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? d3_of(0, 0, 0) : d3_from(s->P);
    s->eye = d3_round(d3_add(from, d3_scale(d3_unit(V), size * (double)rnd_log(1e-5, 1))));
}

/* The bound of one lamp as >>light of shade.h states it, or 0 beyond its limits, among them
   |L + V| > 2e-6; *brink: within 1e-5 of them. */
static double stated_bound(const light_sample *s, double exact, int *brink)
{
    const shade_light *l = &s->lights[0];
    const d3 P = d3_from(s->P), eye = d3_from(s->eye), aim = d3_from(l->spot_direction);
    const int spot = d3_length(aim) > 0;
    const double n = fmax(0, (double)s->material.shininess);
    const double e = spot ? (double)l->spot_exponent : 0;
    double r, I = d3_max(d3_from(l->diffuse));
    d3 N = d3_unit(d3_from(s->N)), L = ref_to_light(l, P, &r);
    d3 V = d3_unit(s->lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? eye : d3_sub(eye, P));
    d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L), H = d3_add(L, V);
    double LS = -d3_dot(L, d3_unit(aim)), off_edge = fabs(LS - (double)l->spot_cos_cutoff);
    double lobe = d3_dot(N, d3_unit(H));
    double least = fabs(d3_dot(N, L));
    if (spot) least = fmin(least, off_edge);
    if (s->lighting.flags & SHADE_FLAG_TWO_SIDED) least = fmin(least, fabs(d3_dot(N, V)));
    if (s->lighting.model == SHADE_MODEL_PHONG) lobe = d3_dot(R, V);
    else least = fmin(least, d3_length(H) - 1e-6);
    *brink = least < 1e-5;
    if (least < 1e-6) return 0;
    if ((n > 0 && n < 1 && fabs(lobe) < 1e-3) || (e > 0 && e < 1 && fabs(LS) < 1e-3)) return 0;
    I = fmax(fmax(I, d3_max(d3_from(l->specular))), d3_max(d3_from(l->ambient)));
    if (l->position.w != 0) {
        I *= ref_attenuation((double)l->constant, (double)l->linear, (double)l->quadratic, r);
    }
    return 5e-5 * fmax(fmax(1, I), exact) * fmax(1, (n + e) / 100);
}

/* Samples crowd at the limits: 70,000 of them lie within 1e-5 of one, and the worst is more than
   a tenth of the bound, so that they are hard enough. */
/* G18 */
TEST(light, the_bound_holds_right_up_to_the_limits_it_is_stated_for)
{
    light_sample s;
    double worst = 0;
    int checked = 0, on_brink = 0, brink = 0;
    for (int i = 0; i < 200000; i++) {
        random_brink_sample(&s);
        ref_lit want = ref_of_sample(&s);
        double bound = stated_bound(&s, d3_max(want.total), &brink);
        if (bound == 0) continue;
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        checked++;
        on_brink += brink;
        worst = fmax(worst, d3_max(d3_sub(d3_from(got), want.total)) / bound);
        if (!check_color(__LINE__, "shade_lit", got, want.total, bound)) print_lights(&s);
    }
    CHECK_SAY(on_brink > 70000, "%d of %d samples within 1e-5 of a limit", on_brink, checked);
    CHECK_SAY(worst > 0.1, "the worst is %g of the bound: the samples are too tame", worst);
}

TEST(light, lit_is_the_sum_of_the_four_terms)
{
    light_sample s;
    for (int i = 0; i < 50000; i++) {
        random_sample(&s);
        shade_terms t = shade_evaluate(&s.lighting, &s.material, s.eye, s.P, s.N);
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        d3 want = d3_add(d3_add(d3_from(t.emission), d3_from(t.ambient)),
                         d3_add(d3_from(t.diffuse), d3_from(t.specular)));
        if (!check_color(__LINE__, "sum", got, want, 1e-6 * d3_max(want))) print_lights(&s);
    }
}

TEST(light, each_bit_of_terms_selects_its_term_alone)
{
    light_sample s;
    shade_vec3 zero = shade_v3(0, 0, 0);
    for (int i = 0; i < 20000; i++) {
        random_sample(&s);
        s.lighting.terms = 0;
        shade_terms all = shade_evaluate(&s.lighting, &s.material, s.eye, s.P, s.N);
        s.lighting.terms = (unsigned)rnd_int(1, 15);
        shade_terms some = shade_evaluate(&s.lighting, &s.material, s.eye, s.P, s.N);
        shade_vec3 e = s.lighting.terms & SHADE_TERM_EMISSION ? all.emission : zero;
        shade_vec3 a = s.lighting.terms & SHADE_TERM_AMBIENT ? all.ambient : zero;
        shade_vec3 d = s.lighting.terms & SHADE_TERM_DIFFUSE ? all.diffuse : zero;
        shade_vec3 h = s.lighting.terms & SHADE_TERM_SPECULAR ? all.specular : zero;
        check_color(__LINE__, "emission", some.emission, d3_from(e), 0);
        check_color(__LINE__, "ambient", some.ambient, d3_from(a), 0);
        check_color(__LINE__, "diffuse", some.diffuse, d3_from(d), 0);
        check_color(__LINE__, "specular", some.specular, d3_from(h), 0);
    }
}

/* ------------------------------------------------------------------ numbers worked out by hand */

static shade_lighting one_light(const shade_light *light)
{
    shade_lighting li = { .lights = light, .light_count = light ? 1 : 0 };
    return li;
}

TEST(light, brass_lit_head_on_and_from_sixty_degrees) /* I_a = 0.3 */
{
    shade_material brass = teapot_brass();
    shade_vec3 origin = grey(0), n = shade_v3(0, 0, 1), eye = shade_v3(0, 0, 5);
    shade_light head = shade_directional_light(shade_v3(0, 0, -1), grey(1));
    shade_lighting li = one_light(&head);
    li.ambient = grey(0.3);
    check_color(__LINE__, "0.3 k_a + k_d + k_s", shade_lit(&li, &brass, eye, origin, n),
                d3_of(1.871373, 1.576862, 0.929803), 2e-6);
    li.model = SHADE_MODEL_PHONG;
    check_color(__LINE__, "0.3 k_a + k_d + k_s", shade_lit(&li, &brass, eye, origin, n),
                d3_of(1.871373, 1.576862, 0.929803), 2e-6);
    shade_light side = shade_directional_light(shade_v3((float)-sqrt(0.75), 0, -0.5f), grey(1));
    li.lights = &side;
    check_color(__LINE__, "R.V = 0.5", shade_lit(&li, &brass, eye, origin, n),
                d3_of(0.489020, 0.351372, 0.065098), 2e-6);
    li.model = SHADE_MODEL_BLINN_PHONG;
    check_color(__LINE__, "N.H = cos 30", shade_lit(&li, &brass, eye, origin, n),
                d3_of(0.506961, 0.368391, 0.079706), 2e-6);
}

TEST(light, the_gate_stops_highlights_behind_the_terminator) /* N.L = -0.14, (N.H)^4 = 0.1849 */
{
    shade_vec3 n = shade_v3(0, 0, 1), l = shade_v3(0.990152f, 0, -0.14f);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, n, 4), 0, 0);
    CHECK_NEAR(shade_phong_specular(n, l, n, 4), 0, 0);
    shade_light light = shade_directional_light(shade_neg(l), grey(1));
    shade_lighting li = one_light(&light);
    shade_material m = { .specular = grey(1), .shininess = 4 };
    check_color(__LINE__, "gated", shade_lit(&li, &m, shade_v3(0, 0, 9), grey(0), n),
                d3_of(0, 0, 0), 0);
    li.flags = SHADE_FLAG_UNGATED_SPECULAR;
    check_color(__LINE__, "ungated", shade_lit(&li, &m, shade_v3(0, 0, 9), grey(0), n),
                d3_of(0.1849, 0.1849, 0.1849), 2e-6);
    li.flags = SHADE_FLAG_UNGATED_SPECULAR | SHADE_FLAG_WEIGHTED_SPECULAR;
    check_color(__LINE__, "weighted", shade_lit(&li, &m, shade_v3(0, 0, 9), grey(0), n),
                d3_of(0, 0, 0), 0);
}

TEST(light, the_gate_is_strict_at_grazing_light) /* N.L = 0 gives 0 */
{
    shade_vec3 n = shade_v3(0, 0, 1), l = shade_v3(1, 0, 0);
    CHECK_NEAR(shade_lambert(n, l), 0, 0);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, n, 4), 0, 0);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, n, 0), 0, 0);
    CHECK_NEAR(shade_phong_specular(n, l, n, 0), 0, 0);
    shade_light light = shade_directional_light(shade_neg(l), grey(1));
    shade_lighting li = one_light(&light);
    shade_material m = teapot_brass();
    m.shininess = 2;
    shade_terms t = shade_evaluate(&li, &m, shade_v3(0, 0, 3), grey(0), n);
    check_color(__LINE__, "diffuse", t.diffuse, d3_of(0, 0, 0), 0);
    check_color(__LINE__, "specular", t.specular, d3_of(0, 0, 0), 0);
    li.flags = SHADE_FLAG_UNGATED_SPECULAR;
    t = shade_evaluate(&li, &m, shade_v3(0, 0, 3), grey(0), n);
    check_color(__LINE__, "specular", t.specular, d3_scale(d3_from(m.specular), 0.5), 1e-6);
}

TEST(light, spot_and_attenuation_multiply) /* cos(20)^2 / (1 + 0.5 r + 0.25 r^2), r = 2 */
{
    double deg = 3.14159265358979 / 180;
    shade_vec3 aim = shade_v3(0, 0, -4);
    shade_vec3 l20 = shade_v3((float)sin(20 * deg), 0, (float)cos(20 * deg));
    shade_vec3 l31 = shade_v3((float)sin(31 * deg), 0, (float)cos(31 * deg));
    CHECK_NEAR(shade_spot(l20, aim, (float)cos(30 * deg), 2), 0.883022, 1e-6);
    CHECK_NEAR(shade_spot(l31, aim, (float)cos(30 * deg), 2), 0, 0);
    CHECK_NEAR(shade_attenuation(1, 0.5f, 0.25f, 2), 1.0 / 3, 1e-7);
    shade_light lamp = shade_spot_light(shade_scale(l20, 2), aim, (float)(30 * deg), 2, grey(1));
    lamp.constant = 1;
    lamp.linear = 0.5f;
    lamp.quadratic = 0.25f;
    shade_lighting li = one_light(&lamp);
    double want = 0.883022 / 3 * cos(20 * deg);
    check_color(__LINE__, "lit",
                shade_lit(&li, NULL, shade_v3(0, 0, 5), grey(0), shade_v3(0, 0, 1)),
                d3_of(want, want, want), 1e-6);
}

TEST(light, four_alpha_looks_like_phong) /* cos(10)^10, cos(5)^10, cos(5)^40 */
{
    double deg = 3.14159265358979 / 180;
    shade_vec3 n = shade_v3(0, 0, 1), v = n,
               l = shade_v3((float)sin(10 * deg), 0, (float)cos(10 * deg));
    CHECK_NEAR(shade_blinn_exponent(10), 40, 0);
    CHECK_NEAR(shade_phong_specular(n, l, v, 10), 0.858054, 3e-6);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, v, 10), 0.962592, 3e-6);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, v, shade_blinn_exponent(10)), 0.858557, 3e-6);
}

TEST(light, cool_to_warm_goes_from_cool_to_warm) /* (1 + N.L) / 2 of warm */
{
    shade_vec3 cool = shade_v3(0.4f, 0.4f, 0.7f), warm = shade_v3(0.8f, 0.6f, 0.6f),
               n = shade_v3(0, 0, 1);
    check_color(__LINE__, "1", shade_cool_to_warm(n, n, cool, warm), d3_of(0.8, 0.6, 0.6), 1e-6);
    check_color(__LINE__, "0", shade_cool_to_warm(n, shade_v3(1, 0, 0), cool, warm),
                d3_of(0.6, 0.5, 0.65), 1e-6);
    check_color(__LINE__, "-1", shade_cool_to_warm(n, shade_neg(n), cool, warm),
                d3_of(0.4, 0.4, 0.7), 1e-6);
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(77));
    /* A directional light has no cone: one that is set changes nothing. */
    light.spot_direction = shade_v3(1, 0, 0);
    light.spot_cos_cutoff = 0.9f;
    shade_lighting li = one_light(&light);
    li.model = SHADE_MODEL_COOL_TO_WARM;
    li.ambient = grey(5);
    shade_material m = teapot_brass();
    m.emission = shade_v3(0.1f, 0.2f, 0.3f);
    check_color(__LINE__, "lit", shade_lit(&li, &m, shade_v3(0, 0, 2), grey(0), n),
                d3_of(0.9, 0.8, 0.9), 1e-6);
    li.light_count = 0;
    check_color(__LINE__, "no light", shade_lit(&li, &m, shade_v3(0, 0, 2), grey(0), n),
                d3_of(0.7, 0.7, 0.95), 1e-6);
    li.terms = SHADE_TERM_DIFFUSE;
    check_color(__LINE__, "diffuse", shade_lit(&li, &m, shade_v3(0, 0, 2), grey(0), n),
                d3_of(0.6, 0.5, 0.65), 1e-6);
    li.terms = SHADE_TERM_AMBIENT | SHADE_TERM_SPECULAR;
    check_color(__LINE__, "none", shade_lit(&li, &m, shade_v3(0, 0, 2), grey(0), n), d3_of(0, 0, 0),
                0);
    li.terms = 0;
    li.cool = shade_v3(0, 0, 1); /* each default alone */
    check_color(__LINE__, "warm", shade_lit(&li, NULL, shade_v3(0, 0, 2), grey(0), n),
                d3_of(0.4, 0.3, 0.8), 1e-6);
}

/* -------------------------------------------------------------------- the functions of one term */

TEST(light, single_terms_match_double)
{
    for (int i = 0; i < 50000; i++) {
        d3 N = rnd_direction(), L = rnd_direction(), V = rnd_direction();
        if (rnd_one_in(2)) {
            d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L);
            V = d3_unit(d3_add(R, d3_scale(rnd_direction(), (double)rnd_log(1e-3, 1))));
        }
        shade_vec3 nf = d3_round(N), lf = d3_round(L), vf = d3_round(V);
        float n = random_exponent();
        double NL = d3_dot(N, L), bound = 5e-5 * fmax(1, (double)n / 100);
        CHECK_NEAR(shade_lambert(nf, lf), fmax(0, NL), 1e-6);
        for (int model = SHADE_MODEL_BLINN_PHONG; model <= SHADE_MODEL_PHONG; model++) {
            int unsure = fabs(NL) < REF_MARGIN;
            double want = ref_highlight((shade_model)model, d3_from(nf), d3_from(lf), d3_from(vf),
                                        (double)n, &unsure);
            float got = model == SHADE_MODEL_PHONG ? shade_phong_specular(nf, lf, vf, n)
                                                   : shade_blinn_phong_specular(nf, lf, vf, n);
            if (!unsure) CHECK_NEAR(got, NL > 0 ? want : 0, bound);
        }
        int unsure = 0;
        d3 aim = d3_scale(rnd_direction(), (double)rnd_log(1e-6, 1e6));
        float cutoff = rnd_float(-1, 1);
        double spot = ref_spot(L, d3_from(d3_round(aim)), (double)cutoff, (double)n, &unsure);
        if (!unsure) CHECK_NEAR(shade_spot(lf, d3_round(aim), cutoff, n), spot, bound);
        float a = rnd_one_in(3) ? 0 : rnd_log(1e-3, 10), b = rnd_one_in(3) ? 0 : rnd_log(1e-3, 10);
        float c = rnd_one_in(3) ? 0 : rnd_log(1e-3, 10), r = rnd_one_in(9) ? 0 : rnd_log(1e-6, 1e6);
        double att = ref_attenuation((double)a, (double)b, (double)c, (double)r);
        CHECK_NEAR(shade_attenuation(a, b, c, r), att, 1e-6 * att);
    }
}

/* G3 */
TEST(light, attenuation_is_defined_everywhere) /* 1 / (a + b r + c r^2) */
{
    shade_light faint = shade_point_light(shade_v3(0, 0, 1), shade_v3(1, 1, 1));
    faint.linear = 1e-25f;    /* one unit away: 1e20 is the most */
    CHECK_NEAR(shade_light_at(&faint, shade_v3(0, 0, 0), NULL, NULL), 1e20, 1e14);
    CHECK_NEAR(shade_attenuation(0, 0, 0, 0), 1, 0);
    CHECK_NEAR(shade_attenuation(0, 0, 0, 1e6f), 1, 0);
    CHECK_NEAR(shade_attenuation(1, 0, 0, 123), 1, 0);
    CHECK_NEAR(shade_attenuation(0, 1, 0, 4), 0.25, 1e-7);
    CHECK_NEAR(shade_attenuation(0, 0, 1, 4), 0.0625, 1e-8);
    CHECK_NEAR(shade_attenuation(0, 0, 1, 0), 1e8, 100);
    CHECK_NEAR(shade_attenuation(0, 1, 0, 0), 1e4, 0.01);
    CHECK_NEAR(shade_attenuation(0, 0, 1, 1e-9f), 1e8, 100);
    CHECK_NEAR(shade_attenuation(2, 1, 1, 0), 0.5, 1e-7);
    CHECK_NEAR(shade_attenuation(0, 0, 1e-30f, 0), 1e20, 1e14);
    CHECK_NEAR(shade_attenuation(1e-30f, 0, 0, 5), 1e20, 1e14);
    CHECK_NEAR(shade_attenuation(1e-45f, 0, 0, 0), 1e20, 1e14);
    CHECK(shade_attenuation(0, 0, 1, 1e12f) > 0.9e-24f);
}

TEST(light, the_cone_includes_its_edge) /* L.S >= cos(beta) */
{
    shade_vec3 aim = shade_v3(0, 0, -1);
    CHECK_NEAR(shade_spot(shade_v3(0, 0, 1), aim, 1, 0), 1, 0);
    CHECK_NEAR(shade_spot(shade_v3(0, 0.6f, 0.8f), aim, 0.8f, 0), 1, 0);
    CHECK_NEAR(shade_spot(shade_v3(0, 0.6f, 0.8f), aim, 0.8f, 1), 0.8, 2e-6);
    CHECK_NEAR(shade_spot(shade_v3(0, 0.6f, 0.8f), aim, 0.80000013f, 0), 0, 0);
    CHECK_NEAR(shade_spot(shade_v3(1, 0, 0), aim, 0, 0), 1, 0);
    CHECK_NEAR(shade_spot(shade_v3(1, 0, 0), aim, 0, 2), 0, 0);
    CHECK_NEAR(shade_spot(shade_v3(0, 0, -1), aim, -1, 0), 1, 0); /* a power of 0 with exponent 0 */
    CHECK_NEAR(shade_spot(shade_v3(0, 0, -1), aim, -1, 3), 0, 0);
    CHECK_NEAR(shade_spot(shade_v3(0, 0, -1), shade_v3(0, 0, 0), 0.9f, 3), 1, 0);
    CHECK_NEAR(shade_spot(shade_v3(0, 0, -1), shade_v3(0, 1e-19f, 0), 0.9f, 3), 1, 0);
}

TEST(light, the_cone_of_a_lamp_includes_its_edge)
{
    shade_light light = shade_spot_light(shade_v3(0, 0, 0), shade_v3(0, 0, -2), 0, 0, grey(1));
    light.position = shade_v4(0, 0, 3, 0); /* on its axis: L.S is 1, to the bit */
    shade_lighting li = one_light(&light);
    float P[3][SHADE_LANES], N[3][SHADE_LANES], rgb[3 * SHADE_LANES];
    memset(P, 0, sizeof P);
    memset(N, 0, sizeof N);
    for (int i = 0; i < SHADE_LANES; i++) N[2][i] = 1;
    static const double cutoff[] = { 1, 1.0000001192092896 };
    for (int k = 0; k < 2; k++) {
        double want = k ? 0 : 1;
        light.spot_cos_cutoff = (float)cutoff[k];
        check_color(__LINE__, "scalar", shade_lit(&li, NULL, grey(9), grey(0), shade_v3(0, 0, 1)),
                    d3_of(want, want, want), 1e-6);
        lit_rows(&li, NULL, grey(9), P[0], N[0], NULL, NULL, rgb);
        for (int i = 0; i < 3 * SHADE_LANES; i++) CHECK_NEAR(rgb[i], want, 1e-6);
    }
}

TEST(light, a_reflectance_without_a_direction_is_the_diffuse_one)
{
    shade_material m = shade_preset_material(SHADE_PRESET_GOLD);
    const shade_vec3 n = shade_v3(0, 0, 1), none = shade_v3(0, 0, 0);
    for (int k = 0; k < 2; k++) {
        shade_vec3 f = shade_brdf(&m, SHADE_MODEL_PHONG, n, k ? none : n, k ? n : none);
        check_color(__LINE__, "no direction", f, d3_from(m.diffuse), 0);
    }
}

TEST(light, brdf_times_cosine_is_the_weighted_light) /* I_L (N.L) f_r */
{
    for (int i = 0; i < 20000; i++) {
        d3 N = rnd_direction(), L = rnd_direction(), V = rnd_direction();
        shade_material m = random_material();
        shade_model model = (shade_model)rnd_int(0, 5);
        shade_vec3 f = shade_brdf(&m, model, d3_round(N), d3_round(L), d3_round(V));
        int unsure = 0;
        d3 want = model <= SHADE_MODEL_LAMBERT ? d3_from(m.diffuse) : d3_of(0, 0, 0);
        if (model <= SHADE_MODEL_PHONG) {
            double s = ref_highlight(model, N, L, V, fmax(0, (double)m.shininess), &unsure);
            want = d3_add(want, d3_scale(d3_from(m.specular), s));
        }
        double bound = 5e-5 * fmax(1, (double)m.shininess / 100);
        if (unsure) continue;
        check_color(__LINE__, "brdf", f, want, bound * fmax(1, d3_max(want)));
        if (model > SHADE_MODEL_LAMBERT || d3_dot(N, L) < REF_MARGIN) continue;
        shade_light light = shade_directional_light(shade_neg(d3_round(L)), grey(1));
        shade_lighting li = one_light(&light);
        li.model = model;
        li.flags = SHADE_FLAG_WEIGHTED_SPECULAR | SHADE_FLAG_INFINITE_VIEWER;
        li.terms = SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR;
        check_color(__LINE__, "weighted", shade_lit(&li, &m, d3_round(V), grey(0), d3_round(N)),
                    d3_scale(want, d3_dot(N, L)), 2 * bound * fmax(1, d3_max(want)));
    }
    shade_vec3 white = shade_brdf(NULL, SHADE_MODEL_BLINN_PHONG, shade_v3(0, 0, 1),
                                  shade_v3(0, 0, 1), shade_v3(0, 0, 1));
    check_color(__LINE__, "white Lambert", white, d3_of(1, 1, 1), 0);
}

/* ------------------------------------------------------------------- what arrives from one lamp */

TEST(light, light_at_is_what_arrives_where_from_and_how_far)
{
    long kinds[3] = { 0, 0, 0 }, cones = 0, dark = 0;
    for (int i = 0; i < 100000; i++) {
        double size = (double)rnd_log(1e-2, 1e6);
        shade_vec3 P = rnd_one_in(4) ? grey(0) : random_vector(size), L, other;
        shade_light light = random_light(P, size);
        float r, amount = shade_light_at(&light, P, &L, &r), again;
        ref_arrival want = ref_arriving(&light, d3_from(P));
        int kind = light.position.w == 0 ? 0 : light.position.w == 1 ? 1 : 2;
        CHECK(finite3(L) && isfinite(amount) && isfinite(r));
        kinds[kind]++;
        check_color(__LINE__, "L", L, want.L, 5e-7);
        if (kind == 0)
            CHECK(r == FLT_MAX);
        else
            CHECK_NEAR(r, want.distance, 5e-7 * want.distance);
        again = shade_light_at(&light, P, &other, NULL);
        CHECK(float_bits(again) == float_bits(amount) && !memcmp(&other, &L, sizeof L));
        again = shade_light_at(&light, P, NULL, &r);
        CHECK(float_bits(again) == float_bits(amount));
        CHECK(float_bits(shade_light_at(&light, P, NULL, NULL)) == float_bits(amount));
        if (want.unsure) continue;
        CHECK_NEAR(amount, want.amount, want.bound);
        if (d3_length(d3_from(light.spot_direction)) == 0) continue;
        cones++;
        dark += want.amount == 0;
    }
    CHECK_SAY(kinds[0] > 10000 && kinds[1] > 10000 && kinds[2] > 10000, "%ld %ld %ld", kinds[0],
              kinds[1], kinds[2]);
    CHECK_SAY(dark > 5000 && cones - dark > 5000, "%ld of %ld outside the cone", dark, cones);
}

TEST(light, no_lamp_is_dark_and_nowhere)
{
    shade_vec3 L = grey(7);
    float r = 7;
    CHECK_NEAR(shade_light_at(NULL, grey(1), &L, &r), 0, 0);
    check_color(__LINE__, "L", L, d3_of(0, 0, 0), 0);
    CHECK_NEAR(r, 0, 0);
    CHECK_NEAR(shade_light_at(NULL, grey(1), NULL, NULL), 0, 0);
}

/* A point, a lamp behind any w, and a lamp at infinity that shines from nowhere. */
TEST(light, at_the_lamp_itself_there_is_no_direction_and_so_no_cone_above_the_horizon)
{
    static const float cutoff[] = { 1, 0.5f, 1e-6f, 0, -1e-6f, -0.5f, -1 };
    for (int kind = 0; kind < 3; kind++) {
        for (int k = 0; k < 8; k++) {
            for (int e = 0; e < 3; e++) {
                shade_vec3 L = grey(7), P = shade_v3(3, -5, 0.25f);
                shade_light light = shade_point_light(P, grey(1));
                float r = 7;
                light.constant = 4; /* 1/4 at r = 0 */
                light.linear = 9;
                if (kind == 1) light.position = shade_v4(-1.5f, 2.5f, -0.125f, -0.5f);
                if (kind == 2) light.position = shade_v4(0, 0, 0, 0);
                if (k < 7) light.spot_direction = shade_v3(0, 2, 0);
                light.spot_cos_cutoff = k < 7 ? cutoff[k] : 1;
                light.spot_exponent = (float)e;
                double want = kind == 2 ? 1 : 0.25;
                if (k < 7 && (cutoff[k] > 0 || e > 0)) want = 0;
                CHECK_NEAR(shade_light_at(&light, P, &L, &r), want, 0);
                check_color(__LINE__, "L", L, d3_of(0, 0, 0), 0);
                if (kind == 2)
                    CHECK(r == FLT_MAX);
                else
                    CHECK_NEAR(r, 0, 0);
            }
        }
    }
}

/* k_d I_d max(0, N.L) amount, with L and amount from shade_light_at, is what shade_lit reflects. */
TEST(light, light_at_times_the_cosine_is_the_diffuse_light)
{
    long lit = 0;
    for (int i = 0; i < 50000; i++) {
        light_sample s;
        random_sample(&s);
        s.lighting.light_count = 1;
        s.lighting.model = SHADE_MODEL_LAMBERT;
        s.lighting.flags = 0;
        s.lighting.terms = SHADE_TERM_DIFFUSE;
        s.lights[0] = random_light(s.P, 3);
        shade_vec3 L, got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        double amount = (double)shade_light_at(&s.lights[0], s.P, &L, NULL);
        double NL = d3_dot(d3_unit(d3_from(s.N)), d3_from(L));
        d3 light = d3_mul(d3_from(s.material.diffuse), d3_from(s.lights[0].diffuse));
        d3 want = d3_scale(light, amount * fmax(0, NL));
        lit += d3_max(want) > 1e-3;
        check_color(__LINE__, "diffuse", got, want, 5e-7 * amount * d3_max(light) + 1e-37);
    }
    CHECK_SAY(lit > 15000, "%ld", lit);
}

/* ----------------------------------------------------------------------------------------- laws */

TEST(light, light_adds_up_and_scales)
{
    for (int i = 0; i < 20000; i++) {
        light_sample s;
        random_sample(&s);
        s.lighting.light_count = 2;
        s.lighting.ambient = grey(0);
        s.material.emission = grey(0);
        if (s.lighting.model == SHADE_MODEL_COOL_TO_WARM)
            s.lighting.model = SHADE_MODEL_BLINN_PHONG;
        s.lights[0] = random_light(s.P, 3);
        s.lights[1] = random_light(s.P, 3);
        shade_vec3 both = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        s.lighting.light_count = 1;
        shade_vec3 first = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        s.lighting.lights = &s.lights[1];
        shade_vec3 second = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        d3 sum = d3_add(d3_from(first), d3_from(second));
        check_color(__LINE__, "sum of lights", both, sum, 1e-6 * d3_max(sum) + 1e-37);
        s.lights[1].ambient = shade_scale(s.lights[1].ambient, 4);
        s.lights[1].diffuse = shade_scale(s.lights[1].diffuse, 4);
        s.lights[1].specular = shade_scale(s.lights[1].specular, 4);
        check_color(__LINE__, "four times", shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N),
                    d3_scale(d3_from(second), 4), 4e-6 * d3_max(d3_from(second)) + 1e-37);
    }
}

TEST(light, two_sided_diffuse_is_two_opposite_lamps) /* |N.L| */
{
    for (int i = 0; i < 5000; i++) {
        shade_vec3 n = d3_round(rnd_direction()), d = d3_round(rnd_direction());
        shade_light lamps[2];
        lamps[0] = shade_directional_light(d, grey(1));
        lamps[1] = shade_directional_light(shade_neg(d), grey(1));
        shade_lighting li = one_light(lamps);
        li.model = SHADE_MODEL_LAMBERT;
        li.flags = SHADE_FLAG_TWO_SIDED_ABS;
        shade_vec3 one = shade_lit(&li, NULL, grey(1), grey(0), n);
        li.flags = 0;
        li.light_count = 2;
        check_color(__LINE__, "abs", one, d3_from(shade_lit(&li, NULL, grey(1), grey(0), n)), 1e-6);
    }
}

TEST(light, turning_toward_the_viewer_equals_turning_the_normal)
{
    for (int i = 0; i < 20000; i++) {
        light_sample s;
        random_sample(&s);
        s.lighting.flags =
            (s.lighting.flags | SHADE_FLAG_TWO_SIDED) & ~(unsigned)SHADE_FLAG_INFINITE_VIEWER;
        double NV = d3_dot(d3_unit(d3_from(s.N)), d3_unit(d3_sub(d3_from(s.eye), d3_from(s.P))));
        if (fabs(NV) < REF_MARGIN) continue;
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        shade_vec3 other = shade_lit(&s.lighting, &s.material, s.eye, s.P, shade_neg(s.N));
        check_color(__LINE__, "either normal", got, d3_from(other), 0);
        s.lighting.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED;
        shade_vec3 plain =
            shade_lit(&s.lighting, &s.material, s.eye, s.P, NV < 0 ? shade_neg(s.N) : s.N);
        check_color(__LINE__, "turned", got, d3_from(plain), 1e-6 * d3_max(d3_from(plain)));
    }
}

TEST(light, any_orthogonal_space_gives_the_same_light)
{
    for (int i = 0; i < 5000; i++) {
        light_sample s;
        random_sample(&s);
        s.P = random_vector(2);
        s.lighting.light_count = 2;
        s.lighting.flags &= ~(unsigned)SHADE_FLAG_INFINITE_VIEWER;
        s.eye = random_vector(4);
        if (s.material.shininess > 100) s.material.shininess = 100;
        for (int k = 0; k < 2; k++) {
            s.lights[k] = random_light(s.P, 5);
            if (s.lights[k].spot_exponent > 50) s.lights[k].spot_exponent = 50;
        }
        ref_lit exact = ref_of_sample(&s);
        shade_mat4 m =
            shade_mat4_mul(shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction())),
                           shade_mat4_translation(random_vector(2)));
        shade_vec3 P = shade_mat4_transform_point(m, s.P),
                   N = shade_mat4_transform_direction(m, s.N);
        shade_vec3 eye = shade_mat4_transform_point(m, s.eye);
        for (int k = 0; k < 2; k++) {
            s.lights[k].position = shade_mat4_transform(m, s.lights[k].position);
            s.lights[k].spot_direction =
                shade_mat4_transform_direction(m, s.lights[k].spot_direction);
        }
        ref_lit moved =
            ref_light(&s.lighting, &s.material, d3_from(P), d3_from(N), d3_from(eye), no_albedo());
        if (exact.unsure || moved.unsure) continue;
        if (d3_max(d3_sub(exact.total, moved.total)) > exact.bound)
            continue; /* lost in rounding m */
        check_color(__LINE__, "moved", shade_lit(&s.lighting, &s.material, eye, P, N), exact.total,
                    2 * exact.bound);
    }
}

/* ---------------------------------------------------------------------------------- degenerates */

/* A normal of 1e-20 has a square that is 0 in float: it counts as none. */
TEST(light, zero_normals_keep_emission_and_ambient_only)
{
    for (int i = 0; i < 20000; i++) {
        light_sample s;
        random_sample(&s);
        s.N = rnd_one_in(2) ? grey(0) : grey(1e-20);
        if (s.lighting.model == SHADE_MODEL_COOL_TO_WARM) s.lighting.model = SHADE_MODEL_PHONG;
        s.lighting.terms = 0;
        shade_terms t = shade_evaluate(&s.lighting, &s.material, s.eye, s.P, s.N);
        check_color(__LINE__, "diffuse", t.diffuse, d3_of(0, 0, 0), 0);
        check_color(__LINE__, "specular", t.specular, d3_of(0, 0, 0), 0);
        ref_lit want = ref_light(&s.lighting, &s.material, d3_from(s.P), d3_of(0, 0, 0),
                                 d3_from(s.eye), no_albedo());
        if (want.unsure) continue;
        check_color(__LINE__, "ambient", t.ambient, want.ambient, want.bound);
    }
}

/* G3 */
TEST(light, light_opposite_to_the_viewer_has_no_halfway_vector) /* L + V = 0 */
{
    shade_vec3 n = shade_v3(0, 0.6f, 0.8f), l = shade_v3(0, 0, 1);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, shade_neg(l), 0), 0, 0);
    CHECK_NEAR(shade_blinn_phong_specular(n, l, shade_neg(l), 12), 0, 0);
    shade_light light = shade_directional_light(shade_neg(l), grey(1));
    shade_lighting li = one_light(&light);
    shade_material m = teapot_brass();
    static const unsigned flags[] = { 0, SHADE_FLAG_UNGATED_SPECULAR };
    for (int k = 0; k < 2; k++) {
        li.flags = flags[k] | SHADE_FLAG_INFINITE_VIEWER;
        m.shininess = k ? 0 : 3;
        shade_terms t = shade_evaluate(&li, &m, shade_neg(l), grey(0), n);
        check_color(__LINE__, "specular", t.specular, d3_of(0, 0, 0), 0);
        check_color(__LINE__, "diffuse", t.diffuse, d3_scale(d3_from(m.diffuse), 0.8), 1e-6);
    }
}

/* G3 */
TEST(light, shininess_zero_is_a_flat_highlight_and_leaks_nothing_without_ks) /* 0^0 = 1 */
{
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(2));
    shade_lighting li = one_light(&light);
    shade_material m = { .specular = shade_v3(0.25f, 0.5f, 1) };
    shade_vec3 n = shade_v3(0.6f, 0, 0.8f), eye = shade_v3(-30, 2, 0.5f);
    check_color(__LINE__, "n 0", shade_lit(&li, &m, eye, grey(0), n), d3_of(0.5, 1, 2), 1e-6);
    m.shininess = -7;
    check_color(__LINE__, "n < 0", shade_lit(&li, &m, eye, grey(0), n), d3_of(0.5, 1, 2), 1e-6);
    m.specular = grey(0);
    m.diffuse = grey(1);
    m.shininess = 0;
    check_color(__LINE__, "planet", shade_lit(&li, &m, eye, grey(0), n), d3_of(1.6, 1.6, 1.6),
                1e-6);
}

/* G3 */
TEST(light, a_lamp_at_the_point_itself_is_finite) /* r = 0 */
{
    for (int i = 0; i < 2000; i++) {
        light_sample s;
        random_sample(&s);
        s.lighting.light_count = 1;
        s.lights[0] = random_light(s.P, 3);
        s.lights[0].position = shade_v4(s.P.x, s.P.y, s.P.z, 1);
        if (s.lighting.model == SHADE_MODEL_COOL_TO_WARM) s.lighting.model = SHADE_MODEL_PHONG;
        ref_lit want = ref_of_sample(&s);
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        CHECK(finite3(got));
        if (!want.unsure) check_color(__LINE__, "lit", got, want.total, want.bound);
    }
}

/* The vector to the eye is zero, and so there is no V. TWO_SIDED, which turns the normal toward
   V, is left out. */
TEST(light, an_eye_at_the_point_itself_is_finite)
{
    for (int i = 0; i < 5000; i++) {
        light_sample s;
        random_sample(&s);
        s.eye = s.lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? grey(0) : s.P;
        s.lighting.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED;
        ref_lit want = ref_of_sample(&s);
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        CHECK(finite3(got));
        if (!want.unsure && !check_color(__LINE__, "lit", got, want.total, want.bound))
            print_lights(&s);
    }
}

TEST(light, missing_arguments_mean_their_defaults)
{
    shade_vec3 n = shade_v3(0, 0, 1), eye = shade_v3(1, 2, 3);
    shade_material m = teapot_brass();
    m.emission = shade_v3(0.5f, 0.25f, 0.125f);
    shade_light light = shade_point_light(shade_v3(0, 0, 2), shade_v3(1, 2, 3));
    light.ambient = shade_v3(0.25f, 0.5f, 0.75f);
    shade_lighting li = one_light(&light);
    li.ambient = shade_v3(1, 0, 0.5f);
    check_color(__LINE__, "lighting NULL", shade_lit(NULL, &m, eye, grey(0), n), d3_of(0, 0, 0), 0);
    shade_terms t = shade_evaluate(NULL, &m, eye, grey(0), n);
    check_color(__LINE__, "lighting NULL", t.emission, d3_of(0, 0, 0), 0);
    check_color(__LINE__, "white Lambert", shade_lit(&li, NULL, eye, grey(0), n),
                d3_of(2.25, 2.5, 4.25), 1e-6);
    d3 unlit = d3_add(d3_from(m.emission), d3_mul(d3_from(m.ambient), d3_from(li.ambient)));
    li.lights = NULL;
    check_color(__LINE__, "lights NULL", shade_lit(&li, &m, eye, grey(0), n), unlit, 1e-6);
    li.lights = &light;
    li.light_count = -5;
    check_color(__LINE__, "count < 0", shade_lit(&li, &m, eye, grey(0), n), unlit, 1e-6);
    li.light_count = 1;
    shade_vec3 blinn = shade_lit(&li, &m, eye, grey(0), n);
    li.model = (shade_model)99;
    check_color(__LINE__, "unknown model", shade_lit(&li, &m, eye, grey(0), n), d3_from(blinn), 0);
}

TEST(light, models_drop_the_terms_of_their_iteration) /* k_e; k_a; k_d; k_s */
{
    shade_material m = teapot_brass();
    m.emission = shade_v3(0.5f, 0.25f, 0.125f);
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(1));
    light.ambient = grey(0.5);
    shade_lighting li = one_light(&light);
    li.ambient = grey(0.25);
    for (int model = 0; model <= SHADE_MODEL_EMISSIVE; model++) {
        li.model = (shade_model)model;
        shade_terms t = shade_evaluate(&li, &m, shade_v3(0, 0, 5), grey(0), shade_v3(0, 0, 1));
        check_color(__LINE__, "emission", t.emission, d3_from(m.emission), 0);
        check_color(__LINE__, "ambient", t.ambient,
                    d3_scale(d3_from(m.ambient), model <= 3 ? 0.75 : 0), 1e-7);
        check_color(__LINE__, "diffuse", t.diffuse,
                    d3_scale(d3_from(m.diffuse), model <= 2 ? 1 : 0), 1e-6);
        check_color(__LINE__, "specular", t.specular,
                    d3_scale(d3_from(m.specular), model <= 1 ? 1 : 0), 3e-6);
    }
}

/* The factors are powers of two, so that the same place is exact for each w, negative ones too. */
TEST(light, a_lamp_of_any_w_stands_at_xyz_over_w)
{
    for (int i = 0; i < 5000; i++) {
        light_sample s;
        random_sample(&s);
        s.P = random_vector(2);
        s.lighting.light_count = 1;
        s.eye = random_vector(5);
        s.lights[0] = random_light(s.P, 4);
        shade_vec3 p = random_vector(4);
        s.lights[0].position = shade_v4(p.x, p.y, p.z, 1);
        if (d3_length(d3_sub(d3_from(p), d3_from(s.P))) < 0.5) continue;
        ref_lit want = ref_of_sample(&s);
        static const float w[] = { 1, 2, -1, 0.25f, -8, 1024 };
        for (int k = 0; k < 6 && !want.unsure; k++) {
            s.lights[0].position = shade_v4(p.x * w[k], p.y * w[k], p.z * w[k], w[k]);
            check_color(__LINE__, "lit", shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N),
                        want.total, want.bound);
        }
    }
}

TEST(light, a_distant_spot_keeps_its_cone)
{
    shade_light light = shade_spot_light(grey(0), shade_v3(0, 0, -1), 0.5f, 4, grey(1));
    light.position = shade_v4(0.28f, 0, 0.96f, 0);
    light.quadratic = 3; /* without effect at infinity */
    shade_lighting li = one_light(&light);
    double want = pow(0.96, 5);
    for (int i = 0; i < 10; i++) {
        check_color(__LINE__, "inside",
                    shade_lit(&li, NULL, grey(9), random_vector(1e3), shade_v3(0, 0, 1)),
                    d3_of(want, want, want), 2e-6);
    }
    light.position = shade_v4(0.6f, 0, 0.8f, 0);
    check_color(__LINE__, "outside", shade_lit(&li, NULL, grey(9), grey(0), shade_v3(0, 0, 1)),
                d3_of(0, 0, 0), 0);
}

/* A lamp 2 above the point falls off by 1/4, and a point 5 to the side is outside its cone: 1/8
   + 1/2, then 1/8 + 1/4 of 1/2, then 1/8. */
TEST(light, ambient_takes_distance_and_cone_only_when_asked)
{
    shade_light light = shade_spot_light(shade_v3(0, 0, 2), shade_v3(0, 0, -1), 0.5f, 0, grey(1));
    light.ambient = grey(0.5);
    light.quadratic = 1;
    shade_lighting li = one_light(&light);
    li.ambient = grey(0.125);
    li.terms = SHADE_TERM_AMBIENT;
    shade_vec3 n = shade_v3(0, 0, 1), off = shade_v3(5, 0, 0);
    check_color(__LINE__, "plain", shade_lit(&li, NULL, grey(9), grey(0), n),
                d3_of(0.625, 0.625, 0.625), 1e-7);
    check_color(__LINE__, "plain", shade_lit(&li, NULL, grey(9), off, n),
                d3_of(0.625, 0.625, 0.625), 1e-7);
    li.flags = SHADE_FLAG_ATTENUATED_AMBIENT;
    check_color(__LINE__, "near", shade_lit(&li, NULL, grey(9), grey(0), n),
                d3_of(0.25, 0.25, 0.25), 1e-6);
    check_color(__LINE__, "outside", shade_lit(&li, NULL, grey(9), off, n),
                d3_of(0.125, 0.125, 0.125), 1e-7);
}

TEST(light, length_of_the_normal_does_not_matter)
{
    for (int i = 0; i < 5000; i++) {
        light_sample s;
        random_sample(&s);
        shade_vec3 a = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        shade_vec3 b = shade_lit(&s.lighting, &s.material, s.eye, s.P, shade_scale(s.N, 1024));
        ref_lit want = ref_of_sample(&s);
        if (!want.unsure) check_color(__LINE__, "longer", b, d3_from(a), 2 * want.bound);
    }
}

TEST(light, constructors_fill_in_what_they_say)
{
    shade_light d = shade_directional_light(shade_v3(0, -2, 0), shade_v3(1, 2, 3));
    check_color(__LINE__, "I_d", d.diffuse, d3_of(1, 2, 3), 0);
    check_color(__LINE__, "I_s", d.specular, d3_of(1, 2, 3), 0);
    check_color(__LINE__, "I_La", d.ambient, d3_of(0, 0, 0), 0);
    CHECK(d.position.w == 0 && d.position.x == 0 && d.position.y > 0 && d.position.z == 0);
    CHECK(d.constant == 0 && d.linear == 0 && d.quadratic == 0);
    check_color(__LINE__, "no spot", d.spot_direction, d3_of(0, 0, 0), 0);
    shade_light p = shade_point_light(shade_v3(4, 5, 6), shade_v3(1, 2, 3));
    CHECK(p.position.x == 4 && p.position.y == 5 && p.position.z == 6 && p.position.w == 1);
    check_color(__LINE__, "I_s", p.specular, d3_of(1, 2, 3), 0);
    CHECK(p.constant == 0 && p.linear == 0 && p.quadratic == 0);
    shade_light s =
        shade_spot_light(shade_v3(4, 5, 6), shade_v3(0, 0, -3), 0.75f, 8, shade_v3(1, 2, 3));
    CHECK_NEAR(s.spot_cos_cutoff, cos(0.75), 1e-7);
    CHECK_NEAR(s.spot_exponent, 8, 0);
    CHECK_VEC(shade_normalize(s.spot_direction), d3_of(0, 0, -1), 1e-7);
    CHECK(s.position.w == 1);
    s = shade_spot_light(grey(0), shade_v3(0, 0, -1), 3.14159265f, 0, grey(1));
    CHECK_NEAR(s.spot_cos_cutoff, -1, 1e-7);
    s = shade_spot_light(grey(0), shade_v3(0, 0, -1), 0, 0, grey(1));
    CHECK_NEAR(s.spot_cos_cutoff, 1, 0);
    const float none[] = { 45, nextafterf(3.14159265f, 4), -1e-6f, NAN, INFINITY };
    for (int k = 0; k < TEST_COUNT(none); k++) {
        s = shade_spot_light(grey(0), shade_v3(0, 0, -1), none[k], 0, grey(1));
        CHECK_SAY(s.spot_cos_cutoff != s.spot_cos_cutoff, "a cutoff of %g", (double)none[k]);
    }
    shade_lighting li = one_light(&d); /* travelling down, it lights what faces up */
    check_color(__LINE__, "up", shade_lit(&li, NULL, grey(1), grey(0), shade_v3(0, 1, 0)),
                d3_of(1, 2, 3), 1e-6);
    check_color(__LINE__, "down", shade_lit(&li, NULL, grey(1), grey(0), shade_v3(0, -1, 0)),
                d3_of(0, 0, 0), 0);
}

/* [Kilgard94]: ambient, diffuse and specular reflection, and shininess / 128. */
static const struct {
    const char *name;
    double v[10];
} preset_table[] = {
    { "emerald",
      { 0.0215, 0.1745, 0.0215, 0.07568, 0.61424, 0.07568, 0.633, 0.727811, 0.633, 0.6 } },
    { "jade", { 0.135, 0.2225, 0.1575, 0.54, 0.89, 0.63, 0.316228, 0.316228, 0.316228, 0.1 } },
    { "obsidian",
      { 0.05375, 0.05, 0.06625, 0.18275, 0.17, 0.22525, 0.332741, 0.328634, 0.346435, 0.3 } },
    { "pearl",
      { 0.25, 0.20725, 0.20725, 1, 0.829, 0.829, 0.296648, 0.296648, 0.296648, 0.088 } },
    { "ruby",
      { 0.1745, 0.01175, 0.01175, 0.61424, 0.04136, 0.04136, 0.727811, 0.626959, 0.626959,
        0.6 } },
    { "turquoise",
      { 0.1, 0.18725, 0.1745, 0.396, 0.74151, 0.69102, 0.297254, 0.30829, 0.306678, 0.1 } },
    { "brass",
      { 0.329412, 0.223529, 0.027451, 0.780392, 0.568627, 0.113725, 0.992157, 0.941176,
        0.807843, 0.21794872 } },
    { "bronze",
      { 0.2125, 0.1275, 0.054, 0.714, 0.4284, 0.18144, 0.393548, 0.271906, 0.166721, 0.2 } },
    { "chrome", { 0.25, 0.25, 0.25, 0.4, 0.4, 0.4, 0.774597, 0.774597, 0.774597, 0.6 } },
    { "copper",
      { 0.19125, 0.0735, 0.0225, 0.7038, 0.27048, 0.0828, 0.256777, 0.137622, 0.086014, 0.1 } },
    { "gold",
      { 0.24725, 0.1995, 0.0745, 0.75164, 0.60648, 0.22648, 0.628281, 0.555802, 0.366065,
        0.4 } },
    { "silver",
      { 0.19225, 0.19225, 0.19225, 0.50754, 0.50754, 0.50754, 0.508273, 0.508273, 0.508273,
        0.4 } },
    { "black plastic", { 0, 0, 0, 0.01, 0.01, 0.01, 0.5, 0.5, 0.5, 0.25 } },
    { "cyan plastic",
      { 0, 0.1, 0.06, 0, 0.50980392, 0.50980392, 0.50196078, 0.50196078, 0.50196078, 0.25 } },
    { "green plastic", { 0, 0, 0, 0.1, 0.35, 0.1, 0.45, 0.55, 0.45, 0.25 } },
    { "red plastic", { 0, 0, 0, 0.5, 0, 0, 0.7, 0.6, 0.6, 0.25 } },
    { "white plastic", { 0, 0, 0, 0.55, 0.55, 0.55, 0.7, 0.7, 0.7, 0.25 } },
    { "yellow plastic", { 0, 0, 0, 0.5, 0.5, 0, 0.6, 0.6, 0.5, 0.25 } },
    { "black rubber", { 0.02, 0.02, 0.02, 0.01, 0.01, 0.01, 0.4, 0.4, 0.4, 0.078125 } },
    { "cyan rubber", { 0, 0.05, 0.05, 0.4, 0.5, 0.5, 0.04, 0.7, 0.7, 0.078125 } },
    { "green rubber", { 0, 0.05, 0, 0.4, 0.5, 0.4, 0.04, 0.7, 0.04, 0.078125 } },
    { "red rubber", { 0.05, 0, 0, 0.5, 0.4, 0.4, 0.7, 0.04, 0.04, 0.078125 } },
    { "white rubber", { 0.05, 0.05, 0.05, 0.5, 0.5, 0.5, 0.7, 0.7, 0.7, 0.078125 } },
    { "yellow rubber", { 0.05, 0.05, 0, 0.5, 0.5, 0.4, 0.7, 0.7, 0.04, 0.078125 } },
};

TEST(light, presets_are_the_table_of_teapots)
{
    CHECK_INT(SHADE_PRESET_COUNT, TEST_COUNT(preset_table));
    for (int k = 0; k < SHADE_PRESET_COUNT; k++) {
        shade_material m = shade_preset_material((shade_preset)k);
        const char *name = preset_table[k].name, *got = shade_preset_name((shade_preset)k);
        const double *v = preset_table[k].v;
        CHECK_SAY(!strcmp(got, name), "got \"%s\", want \"%s\"", got, name);
        check_color(__LINE__, name, m.emission, d3_of(0, 0, 0), 0);
        check_color(__LINE__, name, m.ambient, d3_of(v[0], v[1], v[2]), 1e-7);
        check_color(__LINE__, name, m.diffuse, d3_of(v[3], v[4], v[5]), 1e-7);
        check_color(__LINE__, name, m.specular, d3_of(v[6], v[7], v[8]), 1e-7);
        CHECK_NEAR(m.shininess, 128 * v[9], 1e-5);
    }
}

TEST(light, presets_beyond_the_table_are_white_lambert_without_a_name)
{
    static const shade_preset beyond[] = { SHADE_PRESET_COUNT, (shade_preset)1000,
                                           (shade_preset)-1 };
    for (int k = 0; k < TEST_COUNT(beyond); k++) {
        shade_material m = shade_preset_material(beyond[k]);
        const char *name = shade_preset_name(beyond[k]);
        check_color(__LINE__, "ambient", m.ambient, d3_of(1, 1, 1), 0);
        check_color(__LINE__, "diffuse", m.diffuse, d3_of(1, 1, 1), 0);
        check_color(__LINE__, "specular", m.specular, d3_of(0, 0, 0), 0);
        CHECK(name && !name[0]);
    }
}

/* Colours of a display to linear light: the curve of each of four colours, and no more. */
TEST(light, linear_material_decodes_its_four_colours_and_keeps_the_shininess)
{
    static const float odd[] = { 0, 0.04045f, 1, -0.5f, 1.5f, -INFINITY, INFINITY, 1e-30f };
    for (int i = 0; i < 5000; i++) {
        shade_material m = random_material();
        if (i < SHADE_PRESET_COUNT) m = shade_preset_material((shade_preset)i);
        shade_vec3 *in[4] = { &m.emission, &m.ambient, &m.diffuse, &m.specular };
        if (i >= SHADE_PRESET_COUNT) m.shininess = rnd_nasty();
        for (int k = 0; k < 4 && i > 100; k++) {
            if (rnd_one_in(3)) in[k]->x = odd[rnd_int(0, 7)];
            if (rnd_one_in(3)) in[k]->y = rnd_float(-0.1, 1.1);
            if (rnd_one_in(9)) in[k]->z = (float)NAN;
        }
        shade_material got = shade_linear_material(m);
        const shade_vec3 out[4] = { got.emission, got.ambient, got.diffuse, got.specular };
        for (int k = 0; k < 4; k++) {
            double x = fmax(0, fmin(1, (double)in[k]->x)), y = fmax(0, fmin(1, (double)in[k]->y));
            double z = isnan(in[k]->z) ? 0 : fmax(0, fmin(1, (double)in[k]->z));
            check_color(__LINE__, "colour", out[k],
                        d3_of(ref_decode_srgb(x), ref_decode_srgb(y), ref_decode_srgb(z)), 4e-6);
        }
        CHECK(float_bits(got.shininess) == float_bits(m.shininess) || isnan(m.shininess));
    }
}

typedef struct nasty_light {
    shade_light lights[4];
    shade_lighting lighting;
    shade_material material;
    shade_vec3 v[3];
    float f[4];
} nasty_light;

/* All that the functions of light make of it, one after the other */
static void nasty_results(const nasty_light *n, float out[25])
{
    const shade_vec3 *v = n->v;
    const shade_material *m = &n->material;
    const shade_terms terms = shade_evaluate(&n->lighting, m, v[2], v[0], v[1]);
    const shade_vec3 sums[3] = { shade_lit(&n->lighting, m, v[2], v[0], v[1]),
                                 shade_brdf(m, n->lighting.model, v[0], v[1], v[2]),
                                 shade_cool_to_warm(v[0], v[1], v[2], v[0]) };
    memcpy(out, &terms, sizeof terms);
    memcpy(out + 12, sums, sizeof sums);
    out[21] = shade_spot(v[0], v[1], n->f[0], n->f[1]);
    out[22] = shade_phong_specular(v[0], v[1], v[2], n->f[0]);
    out[23] = shade_blinn_phong_specular(v[0], v[1], v[2], n->f[0]);
    out[24] = shade_attenuation(n->f[0], n->f[1], n->f[2], n->f[3]);
    CHECK(!(out[24] > 1e20f));
}

/* Lamps behind the count are others the second time, and what was on the stack is. */
TEST(light, nan_and_infinity_give_what_the_arguments_alone_say)
{
    static nasty_light n, before;
    for (int i = 0; i < 30000; i++) {
        float first[25], again[25];
        fill_nasty(&n.lights, sizeof n.lights);
        fill_nasty(&n.material, sizeof n.material);
        fill_nasty(n.v, sizeof n.v);
        fill_nasty(n.f, sizeof n.f);
        fill_nasty(&n.lighting.ambient, sizeof n.lighting.ambient);
        n.lighting.lights = n.lights;
        n.lighting.light_count = rnd_int(0, 3);
        n.lighting.model = (shade_model)rnd_int(0, 5);
        n.lighting.flags = (unsigned)rnd_bits();
        n.lighting.terms = (unsigned)rnd_bits();
        nasty_results(&n, first);
        fill_nasty(&n.lights[n.lighting.light_count],
                   (size_t)(4 - n.lighting.light_count) * sizeof n.lights[0]);
        memcpy(&before, &n, sizeof n);
        nasty_results(&n, again);
        CHECK(!memcmp(&before, &n, sizeof n));
        for (int k = 0; k < 25; k++)
            CHECK_SAY(float_bits(first[k]) == float_bits(again[k]) ||
                          (isnan(first[k]) && isnan(again[k])),
                      "result %d: %g and %g", k, (double)first[k], (double)again[k]);
    }
}

/* G3 */
TEST(light, big_and_tiny_finite_input_stays_finite) /* every function is total up to 1e12 */
{
    static const float sizes[] = { 0, 1e-45f, 1e-30f, 1e-18f, 1e-9f, 1, 1e6f, 1e12f };
    for (int i = 0; i < 50000; i++) {
        light_sample s;
        random_sample(&s);
        shade_vec3 *v[4];
        v[0] = &s.P;
        v[1] = &s.N;
        v[2] = &s.eye;
        v[3] = &s.lights[0].spot_direction;
        for (int k = 0; k < 4; k++) {
            *v[k] = shade_v3(rnd_sign() * sizes[rnd_int(0, 7)], rnd_sign() * sizes[rnd_int(0, 7)],
                             rnd_sign() * sizes[rnd_int(0, 7)]);
        }
        s.lights[0].position =
            shade_v4(rnd_sign() * sizes[rnd_int(0, 7)], rnd_sign() * sizes[rnd_int(0, 7)],
                     sizes[rnd_int(0, 7)], (float)rnd_int(0, 1));
        shade_vec3 got = shade_lit(&s.lighting, &s.material, s.eye, s.P, s.N);
        CHECK(finite3(got));
        if (!finite3(got)) print_lights(&s);
    }
}

/* Normals, where spots point and where the light of the sun goes, 1e-18 to 1e18 long. */
/* G3 */
TEST(light, lengths_of_normals_and_directions_do_not_matter)
{
    for (int i = 0; i < 5000; i++) {
        const d3 n = rnd_direction(), way = rnd_direction();
        const float size = rnd_log(1.1e-18, 0.9e18), other = rnd_log(1.1e-18, 0.9e18);
        const shade_vec3 white = shade_v3(1, 1, 1), eye = d3_round(rnd_direction());
        shade_material m = shade_preset_material(SHADE_PRESET_GOLD);
        shade_light lamps[2];
        shade_lighting lighting = { .lights = lamps, .light_count = 2 };
        lamps[0] = shade_directional_light(d3_round(way), white);
        lamps[1] = shade_spot_light(d3_round(d3_scale(way, -2)), d3_round(way), 1, 3, white);
        const shade_vec3 want = shade_lit(&lighting, &m, eye, shade_v3(0, 0, 0), d3_round(n));
        lamps[0] = shade_directional_light(d3_round(d3_scale(way, (double)other)), white);
        lamps[1].spot_direction = d3_round(d3_scale(way, (double)other));
        const shade_vec3 got = shade_lit(&lighting, &m, eye, shade_v3(0, 0, 0),
                                         d3_round(d3_scale(n, (double)size)));
        const double off = d3_length(d3_sub(d3_from(got), d3_from(want)));
        CHECK_SAY(off < 1e-4 || fabs(d3_dot(n, way)) < 1e-5,
                  "%g long: %g %g %g, unit: %g %g %g", (double)size, (double)got.x, (double)got.y,
                  (double)got.z, (double)want.x, (double)want.y, (double)want.z);
    }
}
