// Schedules work once per frame, and slow work after a pause.

/** Runs each named job at most once in the next animation frame. */
export class FrameScheduler {
  #jobs = new Map();
  #request = 0;
  #timers = new Map();

  schedule(name, job) {
    this.#jobs.set(name, job);
    if (!this.#request) this.#request = requestAnimationFrame(() => this.flush());
  }

  /** Runs the scheduled jobs now, so that releasing the pointer never loses the last movement. */
  flush() {
    cancelAnimationFrame(this.#request);
    this.#request = 0;
    const jobs = [...this.#jobs.values()];
    this.#jobs.clear();
    for (const job of jobs) job();
  }

  /** Runs a named job once it has not been scheduled again for `delay` milliseconds. */
  debounce(name, delay, job) {
    clearTimeout(this.#timers.get(name));
    this.#timers.set(name, setTimeout(job, delay));
  }

  stop() {
    cancelAnimationFrame(this.#request);
    this.#jobs.clear();
    for (const timer of this.#timers.values()) clearTimeout(timer);
  }
}
