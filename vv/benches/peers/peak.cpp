// `peak PROGRAM ARGUMENTS…` runs a program and then writes {"peak_bytes": N}: the most memory its process held. It is
// small because a child is charged with what its parent held when it was made. Where it may, it puts the program before
// others: on a busy machine a long step would else be interrupted more often than a short one. With PEAK_SMALL_PAGES in
// the environment the system gives it no huge pages, whatever it asks for.
#include <cstdio>
#include <cstdlib>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int count, char** words) {
  if (count < 2) return 2;
  pid_t child = fork();
  if (child == 0) {
    sched_param lowest{1};
    sched_setscheduler(0, SCHED_RR, &lowest);
    if (std::getenv("PEAK_SMALL_PAGES")) prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
    execvp(words[1], words + 1);
    _exit(127);
  }
  int status;
  rusage usage;
  if (child < 0 || wait4(child, &status, 0, &usage) < 0 || !WIFEXITED(status)) return 1;
  std::printf("{\"peak_bytes\": %ld}\n", usage.ru_maxrss * 1024);
  return WEXITSTATUS(status);
}
