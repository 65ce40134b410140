/* What the program needs of the operating system and Fortran does not have: which file a path
 * means, signals, and counted instructions. Everything that a signal handler calls here is safe
 * there. */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE /* syscall */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#if defined(__linux__)
#include <linux/perf_event.h>
#include <sys/syscall.h>
#endif

#if defined(__GNUC__)
/* Only OpenBLAS has it. */
extern void openblas_set_num_threads(int n) __attribute__((weak));
#else
static void (*const openblas_set_num_threads)(int) = NULL;
#endif

enum { kind_none, kind_file, kind_folder, kind_pipe, kind_other };
enum { most_temporaries = 64, longest_text = 200 };

static char temporaries[most_temporaries][PATH_MAX];
static volatile sig_atomic_t n_temporaries;

/* The only thread that makes files. */
static pthread_t first_thread;

/* Two texts of what is being done, so that one is whole while the other is written. */
static char speaker[32] = "faststrip";
static char doing[2][longest_text];
static volatile sig_atomic_t doing_now;
static volatile sig_atomic_t told, told_at, seconds, quiet;

#if defined(__GNUC__) && defined(__linux__)
/* Fortran's run-time library takes units, buffers and forms from GFORTRAN_* variables, before the
 * program begins. None of them is meant for this program, which could not even say what is wrong
 * with them: they go before any library is started. */
static void forget_run_time_variables(int argc, char **argv, char **environment)
{
    static const char prefix[] = "GFORTRAN_";
    char **kept = environment;

    (void)argc;
    (void)argv;
    for (; *environment; environment++)
        if (strncmp(*environment, prefix, sizeof prefix - 1) != 0)
            *kept++ = *environment;
    *kept = NULL;
}

static void (*before_libraries)(int, char **, char **)
    __attribute__((section(".preinit_array"), used)) = forget_run_time_variables;
#endif

/* The kind of what a path leads to, and the numbers that tell it from all other files. */
int faststrip_identify(const char *path, long long identity[2])
{
    struct stat about;

    identity[0] = identity[1] = 0;
    if (stat(path, &about) != 0)
        return kind_none;
    identity[0] = (long long)about.st_dev;
    identity[1] = (long long)about.st_ino;
    if (S_ISREG(about.st_mode))
        return kind_file;
    if (S_ISDIR(about.st_mode))
        return kind_folder;
    return S_ISFIFO(about.st_mode) ? kind_pipe : kind_other;
}

/* The kind of what has a name; a link is of no other kind. */
int faststrip_name_kind(const char *path)
{
    struct stat about;

    if (lstat(path, &about) != 0)
        return kind_none;
    return S_ISREG(about.st_mode) ? kind_file : S_ISDIR(about.st_mode) ? kind_folder : kind_other;
}

/* A path without links and dots; what does not exist yet keeps its name in its folder. Returns
 * the length, 0 if there is no such path. */
int faststrip_resolve(const char *path, char *out, int capacity)
{
    char full[PATH_MAX], folder[PATH_MAX], name[PATH_MAX], link[PATH_MAX];
    const char *slash;
    ssize_t n;
    int step;

    if (capacity < PATH_MAX || strlen(path) >= sizeof name)
        return 0;
    if (realpath(path, out))
        return (int)strlen(out);
    strcpy(full, path);
    for (step = 0; step < 40; step++) {
        slash = strrchr(full, '/');
        strcpy(name, slash ? slash + 1 : full);
        strcpy(folder, slash ? full : ".");
        if (slash)
            folder[slash - full + 1] = '\0';
        if (!realpath(folder, out) || strlen(out) + strlen(name) + 2 > PATH_MAX)
            return 0;
        strcat(out, "/");
        strcat(out, name);
        n = readlink(out, link, sizeof link - 1);
        if (n < 0)
            return (int)strlen(out);
        link[n] = '\0';
        if (link[0] == '/') {
            strcpy(full, link);
        } else {
            if (strlen(out) - strlen(name) + strlen(link) >= sizeof full)
                return 0;
            strcpy(full, out);
            strcpy(full + strlen(full) - strlen(name), link);
        }
    }
    return 0;
}

/* Does somebody write into a named pipe within some seconds? It stays open, or what was written
 * would be lost. */
int faststrip_is_fed(const char *path, int wait)
{
    struct pollfd pipe = { open(path, O_RDONLY | O_NONBLOCK), POLLIN, 0 };
    struct timespec nap = { 0, 50000000 };
    int i, ready;

    if (pipe.fd < 0)
        return 1;
    for (i = 0; i < 20 * wait; i++) {
        ready = poll(&pipe, 1, 0);
        if (ready > 0 && pipe.revents & POLLIN)
            return 1;
        nanosleep(&nap, NULL);
    }
    return 0;
}

/* Remember a file that has to go if the program ends before its time. */
void faststrip_keep_in_mind(const char *path)
{
    int i;

    for (i = 0; i < n_temporaries; i++)
        if (strcmp(temporaries[i], path) == 0)
            return;
    for (i = 0; i < n_temporaries && temporaries[i][0]; i++)
        ;
    if (i >= most_temporaries || strlen(path) >= PATH_MAX)
        return;
    strcpy(temporaries[i], path);
    if (i == n_temporaries)
        n_temporaries++;
}

/* It has got its name, or is another run's from now on. */
void faststrip_forget(const char *path)
{
    int i;

    for (i = 0; i < n_temporaries; i++)
        if (strcmp(temporaries[i], path) == 0)
            temporaries[i][0] = '\0';
}

static void remove_temporaries(void)
{
    int i;

    for (i = 0; i < n_temporaries; i++)
        if (temporaries[i][0])
            unlink(temporaries[i]);
}

/* Remove what killed runs of this user on this host left in a folder: files with no other name,
 * called prefix, number of the process, underscore, number, ending; but for n of them, by device
 * and file. */
void faststrip_remove_leftovers(const char *folder, const char *prefix, const char *ending,
                                const long long *spared, int n)
{
    DIR *stream = opendir(folder);
    struct dirent *entry;
    struct stat about;
    char path[2 * PATH_MAX], *end;
    const char *name;
    long process;
    int i;

    if (!stream)
        return;
    while ((entry = readdir(stream))) {
        name = entry->d_name;
        if (strncmp(name, prefix, strlen(prefix)) != 0)
            continue;
        name += strlen(prefix);
        if (!isdigit((unsigned char)*name))
            continue;
        process = strtol(name, &end, 10);
        if (process < 1 || process > INT_MAX || *end != '_' || !isdigit((unsigned char)end[1]))
            continue;
        strtol(end + 1, &end, 10);
        if (strcmp(end, ending) != 0)
            continue;
        if (process != getpid() && (kill((pid_t)process, 0) == 0 || errno != ESRCH))
            continue;
        if (snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) >= (int)sizeof path
            || lstat(path, &about) != 0 || !S_ISREG(about.st_mode) || about.st_nlink != 1
            || about.st_uid != geteuid())
            continue;
        for (i = 0; i < n; i++)
            if (spared[2 * i] == (long long)about.st_dev
                && spared[2 * i + 1] == (long long)about.st_ino)
                break;
        if (i == n)
            unlink(path);
    }
    closedir(stream);
}

static void tell(const char *text)
{
    ssize_t n = write(STDERR_FILENO, text, strlen(text));

    (void)n;
}

/* A line to the standard output; not 0 if it cannot be written. */
int faststrip_print(const char *line)
{
    return puts(line) == EOF || fflush(stdout) == EOF;
}

static void append(char *line, size_t capacity, const char *text)
{
    size_t n = strlen(line);

    while (*text && n + 1 < capacity)
        line[n++] = *text++;
    line[n] = '\0';
}

static void append_number(char *line, size_t capacity, int number)
{
    char digits[12];
    int i = sizeof digits - 1;

    digits[i] = '\0';
    do
        digits[--i] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    append(line, capacity, digits + i);
}

struct known_signal {
    int number;
    const char *name, *why;
};

static const char by_fault[] = ", a fault of the program: please report it";
static const struct known_signal known[] = {
    { SIGHUP, "HUP", "" },
    { SIGINT, "INT", "" },
    { SIGTERM, "TERM", "" },
    { SIGPIPE, "PIPE", ": nobody reads the output" },
    { SIGUSR1, "USR1", "" },
    { SIGUSR2, "USR2", "" },
    { SIGQUIT, "QUIT", "" },
    { SIGXCPU, "XCPU", ": the shell's limit of processor time (ulimit -t)" },
    { SIGXFSZ, "XFSZ", ": the shell's limit of file sizes (ulimit -f)" },
    { SIGSEGV, "SEGV", by_fault },
    { SIGBUS, "BUS", by_fault },
    { SIGFPE, "FPE", by_fault },
    { SIGILL, "ILL", by_fault },
    { SIGABRT, "ABRT", by_fault },
};
enum { n_known = sizeof known / sizeof known[0], first_not_ignored = 6 };

/* In the first thread, so that no file is made behind those that are removed; a fault of another
 * thread, at once. */
static void end_by_signal(int number)
{
    char line[longest_text] = "";
    int i;

    for (i = 0; i < n_known && known[i].number != number; i++)
        ;
    if (i < n_known && known[i].why != by_fault && !pthread_equal(pthread_self(), first_thread)
        && pthread_kill(first_thread, number) == 0)
        for (;;)
            pause();
    remove_temporaries();
    append(line, sizeof line, speaker);
    append(line, sizeof line, ": ended by signal ");
    append(line, sizeof line, i < n_known ? known[i].name : "?");
    append(line, sizeof line, " (");
    append_number(line, sizeof line, number);
    append(line, sizeof line, ")");
    append(line, sizeof line, i < n_known ? known[i].why : "");
    append(line, sizeof line, "\n");
    tell(line);
    _exit(128 + number);
}

/* Once a second: what is being done, if that is news; else ever more rarely. Of news, after a
 * minute every ten seconds, after ten minutes every minute. */
static void tell_progress(int number)
{
    char line[longest_text + 40] = "";
    int now = doing_now, saved = errno;

    (void)number;
    seconds++;
    if (quiet)
        return;
    if ((now != told && seconds - told_at >= (seconds < 60 ? 1 : seconds < 600 ? 10 : 60))
        || (seconds & (seconds - 1)) == 0) {
        append(line, sizeof line, speaker);
        append(line, sizeof line, ": ");
        append(line, sizeof line, doing[now & 1]);
        append(line, sizeof line, ", ");
        append_number(line, sizeof line, seconds);
        append(line, sizeof line, " s\n");
        tell(line);
        told = now;
        told_at = seconds;
    }
    errno = saved;
}

/* Let the library of linear algebra use no threads of its own: rows have them. */
void faststrip_use_one_thread_each(void)
{
    if (openblas_set_num_threads)
        openblas_set_num_threads(1);
}

/* Which of the programs speaks, at the start of each line on stderr. */
void faststrip_set_speaker(const char *name)
{
    strncpy(speaker, name, sizeof speaker - 1);
}

/* Do not tell of long work. */
void faststrip_be_quiet(void)
{
    quiet = 1;
}

/* What the lines on stderr say that long work is at. */
void faststrip_set_progress(const char *text)
{
    strncpy(doing[(doing_now + 1) & 1], text, longest_text - 1);
    doing_now++;
}

/* Handle the signals that end a program, and tell of long work from its first second on. */
void faststrip_start_signals(const char *text)
{
    static char stack[65536];
    stack_t other = { .ss_sp = stack, .ss_size = sizeof stack };
    struct sigaction action, old;
    struct itimerval second = { { 1, 0 }, { 1, 0 } };
    int i;

    first_thread = pthread_self();
    faststrip_set_progress(text);
    atexit(remove_temporaries);
    sigaltstack(&other, NULL);
    memset(&action, 0, sizeof action);
    sigfillset(&action.sa_mask);
    action.sa_handler = end_by_signal;
    action.sa_flags = SA_ONSTACK;
    for (i = 0; i < n_known; i++) {
        /* What nohup or the shell made us ignore stays ignored. */
        if (i < first_not_ignored && sigaction(known[i].number, NULL, &old) == 0
            && old.sa_handler == SIG_IGN)
            continue;
        sigaction(known[i].number, &action, NULL);
    }
    action.sa_handler = tell_progress;
    action.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &action, NULL);
    told = doing_now;
    setitimer(ITIMER_REAL, &second, NULL);
}

/* Become another program: n words, each with its closing zero, the program first. Comes back only
 * if there is no such program. */
void faststrip_become(const char *words, int n)
{
    char **list = calloc((size_t)n + 1, sizeof *list);
    int i;

    if (!list)
        return;
    for (i = 0; i < n; i++) {
        list[i] = (char *)words;
        words += strlen(words) + 1;
    }
    execvp(list[0], list);
    free(list);
}

/* Run another program to its end: n words, each with its closing zero, the program first. Its exit
 * code; -1 if there is no such program or it was killed. */
int faststrip_run(const char *words, int n, int is_silent)
{
    extern char **environ;
    char **list = calloc((size_t)n + 1, sizeof *list);
    posix_spawn_file_actions_t actions;
    pid_t process;
    int i, status = 0, code = -1;

    if (!list || posix_spawn_file_actions_init(&actions) != 0) {
        free(list);
        return -1;
    }
    for (i = 0; i < n; i++) {
        list[i] = (char *)words;
        words += strlen(words) + 1;
    }
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (is_silent)
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (posix_spawnp(&process, list[0], &actions, NULL, list, environ) == 0) {
        while ((i = waitpid(process, &status, 0)) < 0 && errno == EINTR)
            ;
        if (i == process && WIFEXITED(status))
            code = WEXITSTATUS(status);
    }
    posix_spawn_file_actions_destroy(&actions);
    free(list);
    return code;
}

/* Do people look at the standard output? */
int faststrip_is_terminal(void)
{
    return isatty(STDOUT_FILENO);
}

/* Make the folders of a file that are not there, from the top down. */
void faststrip_make_folders(const char *path)
{
    char folder[PATH_MAX];
    size_t i;

    for (i = 0; path[i] && i < sizeof folder - 1; i++) {
        folder[i] = path[i];
        folder[i + 1] = '\0';
        if (path[i] == '/' && i > 0 && path[i - 1] != '/' && mkdir(folder, 0777) != 0
            && errno != EEXIST)
            return;
    }
}

/* A new folder that nobody else can enter; the length of its name, 0 if there is none. */
int faststrip_new_folder(char *out, int capacity)
{
    const char *where = getenv("TMPDIR");
    int n = snprintf(out, (size_t)capacity, "%s/faststrip_XXXXXX",
                     where && *where ? where : "/tmp");

    return n > 0 && n < capacity && mkdtemp(out) ? n : 0;
}

/* Remove a folder and the files in it. */
void faststrip_remove_folder(const char *folder)
{
    DIR *stream = opendir(folder);
    struct dirent *entry;
    char path[2 * PATH_MAX];

    if (!stream)
        return;
    while ((entry = readdir(stream)))
        if (snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) < (int)sizeof path)
            unlink(path);
    closedir(stream);
    rmdir(folder);
}

/* Instructions of the calling thread so far, counted from the first call on; -1 where the machine
 * has no counter for them or the kernel does not let us have it. Only one thread may call it. */
long long faststrip_instructions(void)
{
    long long count = -1;
#if defined(__linux__)
    static int counter = -1, is_tried;
    struct perf_event_attr about;

    if (!is_tried) {
        is_tried = 1;
        memset(&about, 0, sizeof about);
        about.type = PERF_TYPE_HARDWARE;
        about.size = sizeof about;
        about.config = PERF_COUNT_HW_INSTRUCTIONS;
        about.exclude_kernel = about.exclude_hv = 1;
        counter = (int)syscall(SYS_perf_event_open, &about, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
    }
    if (counter < 0 || read(counter, &count, sizeof count) != (ssize_t)sizeof count)
        return -1;
#endif
    return count;
}
