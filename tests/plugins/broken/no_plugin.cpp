// A shared object, but no plugin.
int answer() { return 42; }
