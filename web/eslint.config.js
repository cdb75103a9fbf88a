import hooks from 'eslint-plugin-react-hooks';
import tseslint from 'typescript-eslint';

/** All that its makers recommend; what they only warn of is an error here. */
const hookRules = Object.fromEntries(
  Object.keys(hooks.configs.flat['recommended-latest'].rules).map((rule) => [rule, 'error']),
);

export default tseslint.config(
  {
    ignores: [
      'dist',
      'shots',
      'aesl/parser.ts',
      'aesl/parser.terms.ts',
      'protocol/messages.ts',
      'scripts',
      '*.js',
    ],
  },
  ...tseslint.configs.recommendedTypeChecked,
  {
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    languageOptions: {
      parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname },
    },
    plugins: { 'react-hooks': hooks },
    rules: {
      ...hookRules,
      '@typescript-eslint/no-explicit-any': 'error',
      '@typescript-eslint/switch-exhaustiveness-check': [
        'error',
        { considerDefaultExhaustiveForUnions: true },
      ],
      '@typescript-eslint/no-unused-vars': [
        'error',
        { argsIgnorePattern: '^_', varsIgnorePattern: '^_' },
      ],
      // Functions of interfaces are written as methods; none of them uses this.
      '@typescript-eslint/unbound-method': 'off',
      '@typescript-eslint/no-base-to-string': 'off',
      '@typescript-eslint/no-unused-expressions': 'off',
      '@typescript-eslint/restrict-template-expressions': 'off',
      '@typescript-eslint/no-misused-promises': [
        'error',
        { checksVoidReturn: { attributes: false } },
      ],
    },
  },
  {
    files: ['e2e/**'],
    rules: {
      // Files and messages are read as they are: JSON without a type.
      '@typescript-eslint/no-unsafe-argument': 'off',
      '@typescript-eslint/no-unsafe-assignment': 'off',
      '@typescript-eslint/no-unsafe-call': 'off',
      '@typescript-eslint/no-unsafe-member-access': 'off',
      '@typescript-eslint/no-unsafe-return': 'off',
    },
  },
);
