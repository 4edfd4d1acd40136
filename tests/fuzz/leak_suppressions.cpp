// LeakSanitizer reads this function where it is linked in; other builds never call it. Third-party leaks
// only: OpenImageIO 2.4 keeps the last error string of readers that have gone, a few bytes per refused file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOpenImageIO\n";
}
