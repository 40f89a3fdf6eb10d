// Words of commands that people paste into a terminal. Names of cases come from links.

/** A word as a POSIX shell takes it, in quotes: whatever is in it, it is one word. */
export const quoted = (word: string) => `'${word.replaceAll("'", "'\\''")}'`;
