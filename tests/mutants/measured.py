"""Runs a program with limits of time and memory."""
import os, resource, signal, subprocess, time

MEMORY = 8 << 30
STILL = 300  # seconds: what has not had its time of the processor by then and 20 times as long waits for ever


def measured(command, seconds, output):
    """The exit status, None if it took more time of the processor than that. Its words go to a file."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open(output, "w") as words:
        process = subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=words, stderr=words,
                                   start_new_session=True, preexec_fn=limit)
    late = time.time() + STILL + 20 * seconds
    hung = False
    while True:
        pid, status = os.waitpid(process.pid, os.WNOHANG)
        if pid != 0:
            break
        if time.time() > late and not hung:
            hung = True
            os.killpg(process.pid, signal.SIGKILL)
        time.sleep(0.05)
    process.returncode = os.waitstatus_to_exitcode(status)
    in_time = not hung and process.returncode not in (-signal.SIGXCPU, -signal.SIGKILL)
    return process.returncode if in_time else None
