/* Preloaded into the window by files_test.py: while the file named by SLOW_DISK exists, nothing becomes durable. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

static void waitForDisk(void) {
    const char* gate = getenv("SLOW_DISK");
    while (gate && access(gate, F_OK) == 0)
        usleep(5000);
}

int fsync(int file) {
    int (*next)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
    waitForDisk();
    return next(file);
}
