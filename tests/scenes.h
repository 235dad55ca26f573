/* scenes.h - hashes of the built-in scenes; test_main --scenes prints these lines.  0: not recorded
   yet. */
{ "none", 0 },
