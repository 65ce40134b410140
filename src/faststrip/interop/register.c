/* The mutex of the register. A child of a fork must not find it taken by a thread that the child
 * does not have: so a fork waits for it, from the loading of the library on, before anybody can
 * hold it. */
#include <pthread.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

void interop_lock_register(void)
{
    pthread_mutex_lock(&mutex);
}

void interop_unlock_register(void)
{
    pthread_mutex_unlock(&mutex);
}

__attribute__((constructor)) static void let_forks_wait(void)
{
    pthread_atfork(interop_lock_register, interop_unlock_register, interop_unlock_register);
}
